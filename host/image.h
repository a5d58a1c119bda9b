// Framebuffers to and from image files, by OpenImageIO.
#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "host/framebuffer.h"

namespace tessera {

/// Throws kUsage unless the name ends in .png or .exr and its folder can be written: called before any work is done.
void checkImagePath(const std::filesystem::path& path);
/// .png: 8-bit sRGB of `colour` if there is any, else of the attribute (dark blue is the least of `range`, light yellow
/// the most; the span of this frame where no range is given), else of the hits (a logarithmic heat map, dark blue 1 to
/// light yellow for the most of this frame), else of the depth (light is near, dark is far, over the span of this
/// frame); in the last three an empty pixel is transparent. .exr: `id` (uint32) and `Z` (float32), `A` (float32) where
/// the scene has an attribute, `hits` (uint32) under commit=count, and R, G, B (float32, linear) if shaded; bit-exact.
/// Written beside the name and renamed. Throws kUsage as checkImagePath does, kFailure when it cannot be written; one
/// line.
void writeImage(const std::filesystem::path& path, const Framebuffer& frame,
                const std::optional<ValueRange>& range = {});
/// Reads what writeImage put in an .exr. Throws kUsage with one line when it is missing, broken or holds no such
/// channels.
Framebuffer readImage(const std::filesystem::path& path);

/// How two framebuffers differ in what both hold; what one of them does not hold is absent, which is not a 0. They have
/// one size and something to compare (kUsage otherwise).
struct Difference {
  using Count = std::optional<std::uint64_t>;
  std::uint64_t pixels = 0;  ///< compared
  Count coverage;            ///< covered in one and not in the other
  Count id;         ///< another id, coverage differences among them; absent where one knows an id as kUnknownTriangle
  Count depth;      ///< other depth bits
  Count hits;       ///< other hit counts
  Count colour;     ///< other colour bits
  Count attribute;  ///< other bits of the attribute
  std::optional<double> depthMaxAbs;  ///< over the pixels on whose coverage both agree; infinity if one is NaN
  std::optional<double> depthMaxUlp;  ///< the same as distance in float32 steps
  std::optional<double> attributeMax, attributeRms;  ///< of the attribute, where both have a value
  std::optional<double> psnr;                        ///< of colour, dB; infinity when equal
  std::int64_t firstX = -1, firstY = -1;             ///< first differing pixel in row order, -1 if none
  bool equal() const { return firstX < 0; }
};
Difference compare(const Framebuffer& a, const Framebuffer& b);
/// A picture of where they differ, linear RGB: light grey where both agree (darker where something is drawn), vermilion
/// for coverage, blue for another id, yellow for depth alone, purple for hits, attribute or colour alone.
std::vector<glm::vec3> differencePicture(const Framebuffer& a, const Framebuffer& b);

}  // namespace tessera
