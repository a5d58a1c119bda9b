#include "host/plan/plan-scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace tessera::plan {
namespace {

struct Bounds {
  std::array<double, 3> low, high;
  bool empty = true;
};

/// Of the finite positions: the others are dropped in setup.
Bounds boundsOf(std::span<const glm::vec3> positions) {
  Bounds b;
  b.low.fill(std::numeric_limits<double>::infinity());
  b.high.fill(-std::numeric_limits<double>::infinity());
  for (const glm::vec3& p : positions) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) continue;
    b.empty = false;
    for (int i = 0; i < 3; ++i) {
      b.low[i] = std::min(b.low[i], double{p[i]});
      b.high[i] = std::max(b.high[i], double{p[i]});
    }
  }
  return b;
}

/// One of the contract's six distances, and how large its terms were: the measure of its rounding error.
struct Distance {
  double value, size;
};
std::array<Distance, 6> distances(const std::array<double, 4>& p, const std::array<double, 4>& size, double guardX,
                                  double guardY) {
  const auto [x, y, z, w] = p;
  const auto [sx, sy, sz, sw] = size;
  return {{{z, sz},
           {w - z, sw + sz},
           {guardX * w + x, guardX * sw + sx},
           {guardX * w - x, guardX * sw + sx},
           {guardY * w + y, guardY * sw + sy},
           {guardY * w - y, guardY * sw + sy}}};
}

/// Whether the contract's float32 arithmetic may find this point of object space outside a clip plane. Transform and
/// distance round a handful of times, each by 2^-24 of the terms: 1e-5 of their sum is ample.
bool mayBeOutside(const Matrix& m, const std::array<double, 3>& point, double guardX, double guardY) {
  std::array<double, 4> p{}, size{};
  for (int row = 0; row < 4; ++row) {
    for (int i = 0; i < 3; ++i) {
      const double term = m[4 * row + i] * point[i];
      p[row] += term;
      size[row] += std::abs(term);
    }
    p[row] += m[4 * row + 3];
    size[row] += std::abs(m[4 * row + 3]);
  }
  return std::ranges::any_of(distances(p, size, guardX, guardY),
                             [](const Distance& d) { return !(d.value > 1e-5 * d.size); });
}

}  // namespace

bool mayCross(const Scene& scene) {
  const double guardX = 32767.0 / (scene.width * 0.5), guardY = 32767.0 / (scene.height * 0.5);
  if (scene.positions.empty())
    return std::ranges::any_of(scene.clip, [&](const glm::vec4& c) {
      // Given, not computed: only the distance itself rounds, and 0 is inside.
      const std::array<double, 4> p{c.x, c.y, c.z, c.w};
      const bool finite = std::ranges::all_of(p, [](double v) { return std::isfinite(v); });
      return finite && std::ranges::any_of(distances(p, {}, guardX * (1 - 1e-6), guardY * (1 - 1e-6)),
                                           [](const Distance& d) { return d.value < 0; });
    });
  const Bounds bounds = boundsOf(scene.positions);
  if (bounds.empty) return false;
  // The planes bound a convex part of object space: if it holds the corners of the box, it holds the scene. Else each
  // vertex is looked at.
  const auto corner = [&](int c) {
    std::array<double, 3> p{};
    for (int i = 0; i < 3; ++i) p[i] = (c >> i) & 1 ? bounds.high[i] : bounds.low[i];
    return p;
  };
  bool boxInside = true;
  for (int c = 0; c < 8; ++c) boxInside = boxInside && !mayBeOutside(scene.clipFromObject, corner(c), guardX, guardY);
  return !boxInside && std::ranges::any_of(scene.positions, [&](const glm::vec3& p) {
    const bool finite = std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
    return finite && mayBeOutside(scene.clipFromObject, {p.x, p.y, p.z}, guardX, guardY);
  });
}

bool isOrthographic(const Scene& scene) {
  if (scene.positions.empty()) return std::ranges::all_of(scene.clip, [](const glm::vec4& c) { return c.w == 1.0f; });
  const Matrix& m = scene.clipFromObject;  // 0 x is 0 for a finite x, and where x is not finite w is NaN
  return m[12] == 0 && m[13] == 0 && m[14] == 0 && m[15] == 1;
}

}  // namespace tessera::plan
