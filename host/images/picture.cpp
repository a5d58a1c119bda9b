#include "host/images/picture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace tessera::images {
namespace {

// IEC 61966-2-1. NaN and what lies outside [0, 1] are kept in it.
std::uint8_t toSrgb(float linear) {
  const float c = linear > 0 ? std::min(linear, 1.0f) : 0.0f;
  const float coded = c <= 0.0031308f ? 12.92f * c : 1.055f * std::pow(c, 1 / 2.4f) - 0.055f;
  return static_cast<std::uint8_t>(std::lround(coded * 255));
}

// Oklab to linear sRGB (B. Ottosson, A perceptual color space for image processing, 2020).
glm::vec3 fromOklab(float lightness, float a, float b) {
  const auto cube = [](float v) { return v * v * v; };
  const float l = cube(lightness + 0.3963377774f * a + 0.2158037573f * b);
  const float m = cube(lightness - 0.1055613458f * a - 0.0638541728f * b);
  const float s = cube(lightness - 0.0894841775f * a - 1.2914855480f * b);
  return {4.0767416621f * l - 3.3077115913f * m + 0.2309699292f * s,
          -1.2684380046f * l + 2.6097574011f * m - 0.3413193965f * s,
          -0.0041960863f * l - 0.7034186147f * m + 1.7076147010f * s};
}

// A straight line in Oklab, so that even steps look even: dark blue at 0 to light yellow at 1. Lightness rises all the
// way and the hue runs along the blue-yellow axis, which readers who confuse red and green see as well. All of it is
// inside sRGB.
glm::vec3 heat(float t) { return fromOklab(0.32f + 0.62f * t, -0.04f * t, -0.13f + 0.28f * t); }

std::uint8_t* put(const glm::vec3& linear, bool drawn, std::uint8_t* out) {
  out = putSrgb(linear, out);
  *out++ = drawn ? 255 : 0;
  return out;
}

Picture valueMap(std::span<const float> values, std::optional<ValueRange> range) {
  if (!range) {
    range.emplace(ValueRange{std::numeric_limits<float>::max(), std::numeric_limits<float>::lowest()});
    for (const float value : values)
      if (!std::isnan(value)) range->least = std::min(range->least, value), range->most = std::max(range->most, value);
  }
  const double least = range->least, span = range->most - least;  // may be negative: the map is turned round
  return {4, [values, least, span](std::size_t first, std::size_t last, std::uint8_t* out) {
            for (std::size_t k = first; k < last; ++k) {
              const double part = span != 0 ? (values[k] - least) / span : 0.5;
              const bool drawn = !std::isnan(values[k]);
              out = put(drawn ? heat(static_cast<float>(std::clamp(part, 0.0, 1.0))) : glm::vec3(0), drawn, out);
            }
          }};
}

Picture heatMap(const std::vector<std::uint32_t>& hits) {
  // Logarithmic: one hit and two are as far apart as 50 and 100. The scale ends at the most hits of this frame.
  const float most = std::log2(static_cast<float>(std::max(2u, *std::max_element(hits.begin(), hits.end()))));
  return {4, [&hits, most](std::size_t first, std::size_t last, std::uint8_t* out) {
            for (std::size_t k = first; k < last; ++k) {
              const float part = hits[k] ? std::log2(static_cast<float>(hits[k])) / most : 0;
              out = put(hits[k] ? heat(part) : glm::vec3(0), hits[k] != 0, out);
            }
          }};
}

Picture greyDepth(const Framebuffer& frame) {
  // Perspective crowds depths near 1, so grey spans those of this frame: light is near, dark is far.
  const auto covered = [&frame](std::size_t k) { return frame.ids.empty() || frame.ids[k] != kNoTriangle; };
  float nearest = 1, farthest = 0;
  for (std::size_t k = 0; k < frame.pixels(); ++k) {
    if (covered(k)) nearest = std::min(nearest, frame.depth[k]), farthest = std::max(farthest, frame.depth[k]);
  }
  const float range = farthest > nearest ? farthest - nearest : 1;
  return {4, [&frame, covered, nearest, range](std::size_t first, std::size_t last, std::uint8_t* out) {
            for (std::size_t k = first; k < last; ++k) {
              const float far = std::clamp((frame.depth[k] - nearest) / range, 0.0f, 1.0f);
              const auto grey = static_cast<std::uint8_t>(covered(k) ? std::lround(240 - 200 * far) : 0);
              out = std::fill_n(out, 3, grey);
              *out++ = covered(k) ? 255 : 0;
            }
          }};
}

}  // namespace

std::uint8_t* putSrgb(const glm::vec3& linear, std::uint8_t* out) {
  for (int c = 0; c < 3; ++c) *out++ = toSrgb(linear[c]);
  return out;
}

Picture makePicture(const Framebuffer& frame, const std::optional<ValueRange>& range) {
  if (!frame.colour.empty()) {
    return {3, [&frame](std::size_t first, std::size_t last, std::uint8_t* out) {
              for (std::size_t k = first; k < last; ++k) out = putSrgb(frame.colour[k], out);
            }};
  }
  if (!frame.values().empty()) return valueMap(frame.values(), range);
  if (!frame.hits.empty()) return heatMap(frame.hits);
  if (!frame.depth.empty()) return greyDepth(frame);
  return {};
}

}  // namespace tessera::images
