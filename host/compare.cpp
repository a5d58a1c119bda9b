// How two framebuffers differ.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "host/error.h"
#include "host/image.h"

namespace tessera {
namespace {

enum class Part { kNone, kCoverage, kId, kDepth, kHits, kAttribute, kColour };

// What both framebuffers hold, read pixel by pixel.
class Pair {
 public:
  Pair(const Framebuffer& a, const Framebuffer& b)
      : a_(a),
        b_(b),
        ids_(both(a.ids, b.ids)),
        depth_(both(a.depth, b.depth)),
        hits_(both(a.hits, b.hits)),
        attribute_(both(a.attribute, b.attribute)),
        colour_(both(a.colour, b.colour)) {
    if (a.width != b.width || a.height != b.height) {
      failUsage(fmt::format("the images are {} x {} and {} x {} pixels; they should have one size", a.width, a.height,
                            b.width, b.height));
    }
    if (!ids_ && !depth_ && !hits_ && !attribute_ && !colour_)
      failUsage("the images have no channel in common: nothing to compare");
  }

  bool hasCoverage() const { return ids_ || hits_; }
  bool hasIds() const { return ids_; }
  bool hasDepth() const { return depth_; }
  bool hasHits() const { return hits_; }
  bool hasColour() const { return colour_; }
  bool hasAttribute() const { return attribute_; }
  bool idUnknown(std::size_t k) const {
    return ids_ && (a_.ids[k] == kUnknownTriangle || b_.ids[k] == kUnknownTriangle);
  }
  bool covered(std::size_t k) const { return ids_ ? a_.ids[k] != kNoTriangle : hits_ ? a_.hits[k] != 0 : true; }
  bool coverageDiffers(std::size_t k) const {
    if (ids_) return (a_.ids[k] == kNoTriangle) != (b_.ids[k] == kNoTriangle);
    return hits_ && (a_.hits[k] == 0) != (b_.hits[k] == 0);
  }
  bool idDiffers(std::size_t k) const {
    if (!ids_ || a_.ids[k] == b_.ids[k]) return false;
    return !idUnknown(k) || coverageDiffers(k);
  }
  bool depthDiffers(std::size_t k) const { return depth_ && bitsDiffer(a_.depth[k], b_.depth[k]); }
  bool attributeDiffers(std::size_t k) const { return attribute_ && bitsDiffer(a_.attribute[k], b_.attribute[k]); }
  bool hitsDiffer(std::size_t k) const { return hits_ && a_.hits[k] != b_.hits[k]; }
  bool colourDiffers(std::size_t k) const {
    return colour_ && std::memcmp(&a_.colour[k], &b_.colour[k], sizeof(glm::vec3)) != 0;
  }

  /// The most telling difference of a pixel.
  Part part(std::size_t k) const {
    return coverageDiffers(k)    ? Part::kCoverage
           : idDiffers(k)        ? Part::kId
           : depthDiffers(k)     ? Part::kDepth
           : hitsDiffer(k)       ? Part::kHits
           : attributeDiffers(k) ? Part::kAttribute
           : colourDiffers(k)    ? Part::kColour
                                 : Part::kNone;
  }

 private:
  template <typename T>
  static bool both(const std::vector<T>& a, const std::vector<T>& b) {
    return !a.empty() && !b.empty();
  }
  static bool bitsDiffer(float a, float b) {
    return std::bit_cast<std::uint32_t>(a) != std::bit_cast<std::uint32_t>(b);
  }
  const Framebuffer &a_, &b_;
  bool ids_, depth_, hits_, attribute_, colour_;
};

// float32 numbers in order, -0 and +0 at 0: neighbours are 1 apart.
std::int64_t stepOf(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  const auto magnitude = static_cast<std::int64_t>(bits & 0x7fffffffu);
  return bits >> 31 ? -magnitude : magnitude;
}

double squaredDistance(const glm::vec3& a, const glm::vec3& b) {
  double sum = 0;
  for (int c = 0; c < 3; ++c) {
    const double d = static_cast<double>(a[c]) - static_cast<double>(b[c]);
    sum += d * d;
  }
  return sum;
}

// sRGB bytes to linear.
glm::vec3 linear(int r, int g, int b) {
  const auto channel = [](int v) {
    const float c = static_cast<float>(v) / 255;
    return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f);
  };
  return {channel(r), channel(g), channel(b)};
}

}  // namespace

Difference compare(const Framebuffer& a, const Framebuffer& b) {
  const Pair pair(a, b);
  std::uint64_t coverages = 0, ids = 0, depths = 0, hits = 0, attributes = 0, colours = 0;
  double depthMaxAbs = 0, depthMaxUlp = 0, attributeMax = 0, squares = 0, attributeSquares = 0;
  std::uint64_t values = 0;  // pixels that have one in both
  bool idsKnown = pair.hasIds();
  Difference result;
  for (std::size_t k = 0; k < a.pixels(); ++k) {
    const bool coverage = pair.coverageDiffers(k), depth = pair.depthDiffers(k);
    coverages += coverage;
    ids += pair.idDiffers(k);
    depths += depth;
    hits += pair.hitsDiffer(k);
    attributes += pair.attributeDiffers(k);
    colours += pair.colourDiffers(k);
    idsKnown = idsKnown && !pair.idUnknown(k);
    if (depth && !coverage) {
      const double apart = std::abs(static_cast<double>(a.depth[k]) - static_cast<double>(b.depth[k]));
      const auto steps = static_cast<double>(std::abs(stepOf(a.depth[k]) - stepOf(b.depth[k])));
      depthMaxAbs = std::max(depthMaxAbs, std::isnan(apart) ? std::numeric_limits<double>::infinity() : apart);
      depthMaxUlp = std::max(depthMaxUlp, steps);
    }
    if (pair.hasAttribute() && !std::isnan(a.attribute[k]) && !std::isnan(b.attribute[k])) {
      const double apart = std::abs(static_cast<double>(a.attribute[k]) - static_cast<double>(b.attribute[k]));
      attributeMax = std::max(attributeMax, apart);
      attributeSquares += apart * apart;
      ++values;
    }
    if (pair.colourDiffers(k)) squares += squaredDistance(a.colour[k], b.colour[k]);
    if (result.firstX < 0 && pair.part(k) != Part::kNone) {
      result.firstX = static_cast<std::int64_t>(k % a.width);
      result.firstY = static_cast<std::int64_t>(k / a.width);
    }
  }
  result.pixels = a.pixels();
  if (pair.hasCoverage()) result.coverage = coverages;
  if (idsKnown) result.id = ids;
  if (pair.hasDepth()) {
    result.depth = depths;
    result.depthMaxAbs = depthMaxAbs;
    result.depthMaxUlp = depthMaxUlp;
  }
  if (pair.hasHits()) result.hits = hits;
  if (pair.hasAttribute()) {
    result.attribute = attributes;
    result.attributeMax = attributeMax;
    result.attributeRms = values == 0 ? 0 : std::sqrt(attributeSquares / static_cast<double>(values));
  }
  if (pair.hasColour()) {
    result.colour = colours;
    result.psnr = -10 * std::log10(squares / (3 * static_cast<double>(a.pixels())));  // log10(0) is -infinity
  }
  return result;
}

std::vector<glm::vec3> differencePicture(const Framebuffer& a, const Framebuffer& b) {
  // Colours that stay apart for colour-blind readers (M. Okabe, K. Ito: Color Universal Design, 2008).
  const glm::vec3 vermilion = linear(213, 94, 0), blue = linear(0, 114, 178), yellow = linear(240, 228, 66),
                  purple = linear(204, 121, 167);
  const glm::vec3 drawn = linear(190, 190, 190), empty = linear(230, 230, 230);
  const Pair pair(a, b);
  std::vector<glm::vec3> picture;
  picture.reserve(a.pixels());
  for (std::size_t k = 0; k < a.pixels(); ++k) {
    switch (pair.part(k)) {
      case Part::kNone:
        picture.push_back(pair.covered(k) ? drawn : empty);
        break;
      case Part::kCoverage:
        picture.push_back(vermilion);
        break;
      case Part::kId:
        picture.push_back(blue);
        break;
      case Part::kDepth:
        picture.push_back(yellow);
        break;
      case Part::kHits:
      case Part::kAttribute:
      case Part::kColour:
        picture.push_back(purple);
        break;
    }
  }
  return picture;
}

}  // namespace tessera
