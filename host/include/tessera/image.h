// Framebuffers to and from image files.
#pragma once

#include <tessera/framebuffer.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tessera {

/// What an image depends on, by name: the scene's hash, its camera, the axes that change what is right. Nothing of the
/// device that made it, so that two devices write one file. Attributes of an .exr and texts of a .png, each name with
/// "tessera:" before it.
using ImageFacts = std::vector<std::pair<std::string, std::string>>;

/// Linear RGB colours in [0, 1] that are made as they are written, from the top row down.
/// Called with rows [begin, end) of an image; fills `out` with (end - begin) * width colours, row by row.
using ColourRows = std::function<void(std::uint32_t begin, std::uint32_t end, glm::vec3* out)>;

/// Where one image goes, made before the work and kept. Its name ends in .png or .exr; a name that does not say (a
/// pipe, a device, - for stdout) has the format before it, as in png:- and exr:/dev/fd/3.
///
/// .png: 8-bit sRGB of `colour` if there is any, else of the attribute (dark blue is the least of `range`, light yellow
/// the most; the span of this frame where no range is given), else of the hits (a logarithmic heat map, dark blue 1 to
/// light yellow for the most of this frame), else of the depth (light is near, dark is far, over the span of this
/// frame); in the last three an empty pixel is transparent. .exr: `id` (uint32) and `Z` (float32), `A` (float32) where
/// the scene has an attribute, `hits` (uint32) under commit=count, and R, G, B (float32, linear) if shaded; bit-exact.
class ImageOutput {
 public:
  /// Throws kUsage, one line, for a name without a format and where nothing can be written.
  explicit ImageOutput(const std::string& name);
  ~ImageOutput();
  ImageOutput(ImageOutput&&) noexcept;        ///< moves the output; the old object may only be destroyed
  const std::filesystem::path& path() const;  ///< the name without its format
  /// Written into a temporary file, read back and compared; then it is the output. Throws kFailure, one line, when that
  /// cannot be done; what was there is there still.
  void write(const Framebuffer& frame, const std::optional<ValueRange>& range = {}, const ImageFacts& facts = {});
  /// Writes as above a picture of `width` x `height` colours alone: 8-bit sRGB in a .png, float32 linear in an .exr.
  /// The writer asks for the rows in bands, so that a picture does not have to be in memory as a whole.
  void write(std::uint32_t width, std::uint32_t height, const ColourRows& rows, const ImageFacts& facts = {});

 private:
  struct State;
  std::unique_ptr<State> state_;
};
/// Writes a frame as ImageOutput does, in one call: `path` as ImageOutput takes a name. Throws as ImageOutput does.
void writeImage(const std::filesystem::path& path, const Framebuffer& frame,
                const std::optional<ValueRange>& range = {}, const ImageFacts& facts = {});

/// An .exr that writeImage wrote, a band of rows at a time. Throws kUsage with one line when it is missing, broken,
/// holds no such channels, or takes more than `limit` bytes unpacked (0: see exr-header.h).
class ImageReader {
 public:
  /// Opens the file and reads its header. `limit`: the most bytes that the unpacked image may take.
  explicit ImageReader(const std::filesystem::path& path, std::uint64_t limit = 0);
  ~ImageReader();
  std::uint32_t width() const;      ///< pixels
  std::uint32_t height() const;     ///< pixels
  const ImageFacts& facts() const;  ///< in the order of their names
  std::uint32_t bandRows() const;   ///< how many rows are best read at once
  /// Reads the rows from `begin` up to `end`, without `end`, in place of what `band` held: `band` becomes a framebuffer
  /// of width() x (end - begin) pixels.
  void read(std::uint32_t begin, std::uint32_t end, Framebuffer& band);

 private:
  struct State;
  std::unique_ptr<State> state_;
};
/// Reads a whole image, as ImageReader does. Throws as ImageReader does.
Framebuffer readImage(const std::filesystem::path& path, std::uint64_t limit = 0);

/// Reading and writing load a shared library, which takes long: this begins on a thread of its own.
void startLoadingImages();
/// Waits until it is there: the milliseconds that the loading took. Throws kFailure with one line if it cannot be.
double finishLoadingImages();

/// How two framebuffers differ in what both hold; what one of them does not hold is absent, which is not a 0. They have
/// one size and something to compare (kUsage otherwise).
struct Difference {
  using Count = std::optional<std::uint64_t>;  ///< pixels; absent where not both hold what is counted
  std::uint64_t pixels = 0;  ///< compared
  Count coverage;            ///< covered in one and not in the other
  Count id;         ///< another id, coverage differences among them; absent where one knows an id as kUnknownTriangle
  Count depth;      ///< other depth bits
  Count hits;       ///< other hit counts
  Count colour;     ///< other colour bits
  Count attribute;  ///< other bits of the attribute
  std::optional<double> depthMaxAbs;  ///< over the pixels on whose coverage both agree; infinity if one is NaN
  std::optional<double> depthMaxUlp;  ///< the same as distance in float32 steps
  std::optional<double> attributeMax;  ///< largest |a - b| of the attribute, over pixels where both have a value
  std::optional<double> attributeRms;  ///< root of the mean square of a - b over the same pixels
  std::optional<double> colourMax;     ///< largest |a - b| of R, G and B; infinity if one is NaN
  std::optional<double> psnr;                        ///< of colour, dB; infinity when equal
  std::uint64_t anywhere = 0;                        ///< pixels that differ in any of these
  std::int64_t firstX = -1;                          ///< column of the first differing pixel in row order, -1 if none
  std::int64_t firstY = -1;                          ///< row of that pixel, -1 if none
  bool equal() const { return firstX < 0; }          ///< whether no compared pixel differs
};
/// Compares two framebuffers of one size, pixel by pixel and bit by bit. Throws kUsage where the sizes differ, and
/// where there is nothing that both hold.
Difference compare(const Framebuffer& a, const Framebuffer& b);
/// A picture of where they differ, linear RGB: light grey where both agree (darker where something is drawn), vermilion
/// for coverage, blue for another id, yellow for depth alone, purple for hits, attribute or colour alone. The
/// framebuffers have one size, and the picture has a colour for each of their pixels, row-major.
std::vector<glm::vec3> differencePicture(const Framebuffer& a, const Framebuffer& b);

}  // namespace tessera
