// The contract's sections Transform, Dropped, Project, Snap and Orient.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "host/reference-clip.h"
#include "host/reference.h"

namespace tessera::reference {
namespace {

bool isFinite(const glm::vec4& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && std::isfinite(v.w);
}

struct Snapped {
  std::int32_t x, y;  ///< 1/256 pixel, |.| <= 2^24
  float z;
};

// Nearest integer, ties to even. Nothing if it is not within 2^24 either way, NaN included.
std::optional<std::int32_t> snap(float s) {
  constexpr float kLimit = 16777216.0f;
  if (!(s >= -kLimit && s <= kLimit)) return std::nullopt;
  const float whole = std::floor(s);
  const float part = s - whole;
  const auto n = static_cast<std::int32_t>(whole);
  return part > 0.5f || (part == 0.5f && n % 2 != 0) ? n + 1 : n;
}

std::optional<Snapped> project(const glm::vec4& v, float halfWidth, float halfHeight) {
  const float r = 1.0f / v.w;
  if (!(v.w > 0) || !std::isfinite(r)) return std::nullopt;
  const auto x = snap(((v.x * r) * halfWidth + halfWidth) * 256.0f);
  const auto y = snap(((v.y * r) * halfHeight + halfHeight) * 256.0f);
  if (!x || !y) return std::nullopt;
  const float z = v.z * r;
  return Snapped{*x, *y, z > 0 ? (z < 1 ? z : 1.0f) : 0.0f};
}

// Twice the signed area in (1/256 pixel)^2, at most 2^51; negative is counter-clockwise on the screen, whose y points
// down.
std::int64_t doubleArea(const Snapped& a, const Snapped& b, const Snapped& c) {
  return std::int64_t{b.x - a.x} * (c.y - a.y) - std::int64_t{c.x - a.x} * (b.y - a.y);
}

void addPiece(std::uint32_t id, const glm::vec4& a, const glm::vec4& b, const glm::vec4& c, const Scene& scene,
              Cull cull, std::vector<Piece>& pieces, Counts& counts) {
  const float halfWidth = static_cast<float>(scene.width) * 0.5f;
  const float halfHeight = static_cast<float>(scene.height) * 0.5f;
  const auto v0 = project(a, halfWidth, halfHeight);
  auto v1 = project(b, halfWidth, halfHeight);
  auto v2 = project(c, halfWidth, halfHeight);
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
  if ((cull == Cull::kBack && !front) || (cull == Cull::kFront && front)) {
    ++counts.facing;
    return;
  }
  if (front) std::swap(v1, v2);
  pieces.push_back({id, {v0->x, v1->x, v2->x}, {v0->y, v1->y, v2->y}, {v0->z, v1->z, v2->z}});
}

}  // namespace

std::vector<glm::vec4> transform(const Scene& scene) {
  if (scene.positions.empty()) return scene.clip;
  const Matrix& m = scene.clipFromObject;
  std::vector<glm::vec4> clip;
  clip.reserve(scene.positions.size());
  for (const glm::vec3& p : scene.positions) {
    const auto row = [&](int r) { return ((m[4 * r] * p.x + m[4 * r + 1] * p.y) + m[4 * r + 2] * p.z) + m[4 * r + 3]; };
    clip.emplace_back(row(0), row(1), row(2), row(3));
  }
  return clip;
}

std::vector<Piece> pieces(const Scene& scene, const Image& image, Counts* counts) {
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
      addPiece(id, polygon[0], polygon[i - 1], polygon[i], scene, image.cull, result, counted);
    }
  }
  if (counts) *counts = counted;
  return result;
}

}  // namespace tessera::reference
