// The contract's sections Transform, Dropped, Project, Snap and Orient.
#include <tessera/oracle.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "host/oracle/reference-clip.h"
#include "host/oracle/reference-project.h"

namespace tessera::oracle {
namespace {

bool isFinite(const glm::vec4& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && std::isfinite(v.w);
}

// A position in pixels to 1/256 pixel, by the nearest multiple of 2^-bits pixels, ties to even; with no bits, by the
// nearest sample. Nothing if it is not within 2^24 either way, NaN included.
std::optional<std::int32_t> snap(float position, int bits) {
  constexpr std::int64_t kLimit = 1 << 24;
  const float s = bits == 0 ? position - 0.5f : position * static_cast<float>(1 << bits);
  if (!(s >= -static_cast<float>(kLimit) && s <= static_cast<float>(kLimit))) return std::nullopt;
  const float whole = std::floor(s);
  const float part = s - whole;
  auto n = static_cast<std::int64_t>(whole);
  if (part > 0.5f || (part == 0.5f && n % 2 != 0)) ++n;
  const std::int64_t snapped = bits == 0 ? 256 * n + 128 : n * (1 << (8 - bits));
  if (snapped < -kLimit || snapped > kLimit) return std::nullopt;
  return static_cast<std::int32_t>(snapped);
}

// Twice the signed area in (1/256 pixel)^2, at most 2^51; negative is counter-clockwise on the screen, whose y points
// down.
std::int64_t doubleArea(const Snapped& a, const Snapped& b, const Snapped& c) {
  return std::int64_t{b.x - a.x} * (c.y - a.y) - std::int64_t{c.x - a.x} * (b.y - a.y);
}

void addPiece(std::uint32_t id, const glm::vec4& a, const glm::vec4& b, const glm::vec4& c, const Scene& scene,
              const ImageAxes& axes, std::vector<Piece>& pieces, Counts& counts) {
  const auto v0 = project(a, scene, axes);
  auto v1 = project(b, scene, axes);
  auto v2 = project(c, scene, axes);
  if (!v0 || !v1 || !v2) {
    ++counts.behind;
    return;
  }
  const std::int64_t area2 = doubleArea(*v0, *v1, *v2);
  if (area2 == 0) {
    ++counts.zeroArea;
    return;
  }
  const bool front = area2 < 0;
  if ((axes.cull == Cull::kBack && !front) || (axes.cull == Cull::kFront && front)) {
    ++counts.facing;
    return;
  }
  if (front) std::swap(v1, v2);
  pieces.push_back({id, {v0->x, v1->x, v2->x}, {v0->y, v1->y, v2->y}, {v0->z, v1->z, v2->z}});
}

}  // namespace

std::optional<Snapped> project(const glm::vec4& v, const Scene& scene, const ImageAxes& axes) {
  const float halfWidth = static_cast<float>(scene.width) * 0.5f;
  const float halfHeight = static_cast<float>(scene.height) * 0.5f;
  const float r = 1.0f / v.w;
  if (!(v.w > 0) || !std::isfinite(r)) return std::nullopt;
  const auto x = snap((v.x * r) * halfWidth + halfWidth, axes.subPixelBits);
  const auto y = snap((v.y * r) * halfHeight + halfHeight, axes.subPixelBits);
  if (!x || !y) return std::nullopt;
  const float z = v.z * r;
  return Snapped{*x, *y, z > 0 ? (z < 1 ? z : 1.0f) : 0.0f};
}

std::vector<glm::vec4> transform(const Scene& scene) {
  if (scene.positions.empty()) return {scene.clip.begin(), scene.clip.end()};
  const Matrix& m = scene.clipFromObject;
  std::vector<glm::vec4> clip;
  clip.reserve(scene.positions.size());
  for (const glm::vec3& p : scene.positions) {
    const auto row = [&](int r) { return ((m[4 * r] * p.x + m[4 * r + 1] * p.y) + m[4 * r + 2] * p.z) + m[4 * r + 3]; };
    clip.emplace_back(row(0), row(1), row(2), row(3));
  }
  return clip;
}

std::vector<Piece> pieces(const Scene& scene, const ImageAxes& axes, Counts* counts) {
  const std::vector<glm::vec4> vertices = transform(scene);
  Counts counted;
  std::vector<Piece> result;
  for (std::uint32_t id = 0; id < scene.triangles.size(); ++id) {
    ++counted.submitted;
    const Triangle& triangle = scene.triangles[id];
    if (std::any_of(triangle.begin(), triangle.end(), [&](std::uint32_t i) { return i >= vertices.size(); })) {
      ++counted.badIndex;
      continue;
    }
    const std::array corners{vertices[triangle[0]], vertices[triangle[1]], vertices[triangle[2]]};
    if (!std::all_of(corners.begin(), corners.end(), isFinite)) {
      ++counted.nonFinite;
      continue;
    }
    const auto [polygon, outsideSome] = clip(corners, scene.width, scene.height);
    counted.outside += polygon.empty();
    counted.clipped += outsideSome;
    for (std::size_t i = 2; i < polygon.size(); ++i) {
      addPiece(id, polygon[0], polygon[i - 1], polygon[i], scene, axes, result, counted);
    }
  }
  if (counts) *counts = counted;
  return result;
}

}  // namespace tessera::oracle
