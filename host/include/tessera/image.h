// Writes framebuffers to image files, reads them from image files, and compares them.
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

/// What an image depends on, by name: the scene's hash, its camera, and the axes that change what is right. The facts
/// say nothing of the device that made the image, so two devices write the same file. The facts become attributes of an
/// .exr and texts of a .png, with "tessera:" before each name.
using ImageFacts = std::vector<std::pair<std::string, std::string>>;

/// Makes linear RGB colours in [0, 1] while a picture is written, from the top row down. The function is called with
/// the rows [begin, end) of an image, and fills `out` with (end - begin) * width colours, row by row.
using ColourRows = std::function<void(std::uint32_t begin, std::uint32_t end, glm::vec3* out)>;

/// The place where one image goes. An output is made before the work, so that a bad name is refused early. The name
/// ends in .png or .exr. A name that does not say the format (a pipe, a device, - for stdout) has the format before it,
/// as in png:- and exr:/dev/fd/3.
///
/// A .png is 8-bit sRGB. It shows the first of these rasters that the frame has:
/// - `colour`.
/// - The attribute. Dark blue is the least value of `range`, light yellow the most. Where no range is given, the range
///   is the span of this frame.
/// - The hits, as a logarithmic heat map from dark blue for 1 to light yellow for the most of this frame.
/// - The depth, over the span of this frame: light is near, dark is far.
///
/// In a picture of attribute, hits or depth, an empty pixel is transparent.
///
/// An .exr is bit-exact. It has the channels `id` (uint32) and `Z` (float32), `A` (float32) where the scene has an
/// attribute, `hits` (uint32) under commit=count, and R, G, B (float32, linear) where the frame is shaded.
class ImageOutput {
 public:
  /// Throws kUsage with one line for a name without a format, and for a place where nothing can be written.
  explicit ImageOutput(const std::string& name);
  ~ImageOutput();
  ImageOutput(ImageOutput&&) noexcept;        ///< moves the output; the old object may only be destroyed
  const std::filesystem::path& path() const;  ///< the name without its format
  /// Writes the frame into a temporary file, reads the file back and compares it with the frame. Only then does the
  /// file become the output. Throws kFailure with one line where this cannot be done; an older file then stays as it
  /// was.
  void write(const Framebuffer& frame, const std::optional<ValueRange>& range = {}, const ImageFacts& facts = {});
  /// Writes, in the same way, a picture that has `width` x `height` colours and nothing else: 8-bit sRGB in a .png,
  /// float32 linear in an .exr. The writer asks for the rows in bands, so a picture need not be in memory as a whole.
  void write(std::uint32_t width, std::uint32_t height, const ColourRows& rows, const ImageFacts& facts = {});

 private:
  struct State;
  std::unique_ptr<State> state_;
};
/// Writes a frame as ImageOutput does, in one call. `path` is a name as ImageOutput takes it. Throws as ImageOutput
/// does.
void writeImage(const std::filesystem::path& path, const Framebuffer& frame,
                const std::optional<ValueRange>& range = {}, const ImageFacts& facts = {});

/// Reads an .exr that writeImage wrote, a band of rows at a time. Throws kUsage with one line where the file is missing
/// or broken, does not hold the channels of ImageOutput, or takes more than `limit` bytes unpacked. A limit of 0 stands
/// for the default limit of exr-header.h.
class ImageReader {
 public:
  /// Opens the file and reads its header. `limit` is the number of bytes that the unpacked image may take at most.
  explicit ImageReader(const std::filesystem::path& path, std::uint64_t limit = 0);
  ~ImageReader();
  std::uint32_t width() const;      ///< pixels
  std::uint32_t height() const;     ///< pixels
  const ImageFacts& facts() const;  ///< in the order of their names
  std::uint32_t bandRows() const;   ///< the number of rows that is best to read at once
  /// Reads the rows [begin, end). `band` loses what it held and becomes a framebuffer of width() x (end - begin)
  /// pixels.
  void read(std::uint32_t begin, std::uint32_t end, Framebuffer& band);

 private:
  struct State;
  std::unique_ptr<State> state_;
};
/// Reads a whole image, as ImageReader does. Throws as ImageReader does.
Framebuffer readImage(const std::filesystem::path& path, std::uint64_t limit = 0);

/// Reading and writing load a shared library, which takes long. This function begins to load the library on a thread of
/// its own.
void startLoadingImages();
/// Waits until the library is loaded, and returns the milliseconds that loading took. Throws kFailure with one line
/// where the library cannot be loaded.
double finishLoadingImages();

/// How two framebuffers differ in the rasters that both hold. Where one of the two does not hold a raster, the raster's
/// numbers are absent, which is not a 0.
struct Difference {
  using Count = std::optional<std::uint64_t>;  ///< a number of pixels; absent where not both hold the raster
  std::uint64_t pixels = 0;                    ///< pixels that were compared
  Count coverage;                              ///< covered in one framebuffer and not in the other
  Count id;         ///< other ids, with differences of coverage; absent where one of the two has a kUnknownTriangle
  Count depth;      ///< other depth bits
  Count hits;       ///< other hit counts
  Count colour;     ///< other colour bits
  Count attribute;  ///< other bits of the attribute
  std::optional<double> depthMaxAbs;   ///< largest |a - b| where both agree on coverage; infinity if one is NaN
  std::optional<double> depthMaxUlp;   ///< the same, as a distance in float32 steps
  std::optional<double> attributeMax;  ///< largest |a - b| of the attribute, over the pixels where both have a value
  std::optional<double> attributeRms;  ///< root of the mean square of a - b over the same pixels
  std::optional<double> colourMax;     ///< largest |a - b| of R, G and B; infinity if one is NaN
  std::optional<double> psnr;          ///< of the colours, in dB; infinity where they are equal
  std::uint64_t anywhere = 0;          ///< pixels that differ in any raster
  std::int64_t firstX = -1;            ///< column of the first differing pixel in row order, -1 if none
  std::int64_t firstY = -1;            ///< row of the first differing pixel, -1 if none
  bool equal() const { return firstX < 0; }  ///< whether no compared pixel differs
};
/// Compares two framebuffers of one size, pixel by pixel and bit by bit. Throws kUsage where the sizes differ, and
/// where there is no raster that both hold.
Difference compare(const Framebuffer& a, const Framebuffer& b);
/// A picture of where two framebuffers of one size differ. Pixels where both agree are light grey, or darker grey where
/// something is drawn. Vermilion is another coverage, blue another id, yellow another depth alone, and purple other
/// hits, another attribute or another colour alone. The picture has a linear RGB colour for each pixel, row-major.
std::vector<glm::vec3> differencePicture(const Framebuffer& a, const Framebuffer& b);

}  // namespace tessera
