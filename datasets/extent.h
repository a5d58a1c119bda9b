// Which vertices of a scene count, and where its coordinates begin.
#pragma once

#include <tessera/scene.h>

#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <vector>

namespace tessera::datasets {

/// No coordinate is NaN or beyond float32.
bool withinFloat32(const glm::dvec3& point);

bool hasArea(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

/// The corners of the triangles that a frame can show: those with all indices in range, all corners within float32 and
/// an area.
template <class PositionOf>  // of an index below `count`
std::vector<bool> drawnVertices(std::size_t count, std::span<const Triangle> triangles, PositionOf positionOf) {
  std::vector<bool> within(count), drawn(count);
  for (std::size_t v = 0; v < count; ++v) within[v] = withinFloat32(positionOf(v));
  for (const auto& [a, b, c] : triangles)
    if (a < count && b < count && c < count && within[a] && within[b] && within[c] &&
        hasArea(positionOf(a), positionOf(b), positionOf(c)))
      drawn[a] = drawn[b] = drawn[c] = true;
  return drawn;
}

struct Box {
  glm::dvec3 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};

  void add(const glm::dvec3& point);
  bool empty() const { return !(low.x <= high.x); }
  glm::dvec3 centre() const { return (low + high) / 2.0; }
};

/// What is taken from the coordinates of points in a box before they are rounded to float32: 0 unless the box's centre
/// is farther from 0 than twice the box's diagonal, else the centre rounded to a multiple of the power of two above the
/// diagonal. So points near 0 keep every bit, and points that move by a multiple of that power change none.
glm::dvec3 originOf(const Box& box);

}  // namespace tessera::datasets
