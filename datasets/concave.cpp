// Polygons that are not convex, cut by mapbox' earcut (ear clipping with a z-order curve).
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <mapbox/earcut.hpp>
#include <numeric>
#include <set>

#include "datasets/faces.h"

namespace tessera::datasets {
namespace {

/// How deep a corner may be set back, against the length of the outline, before a polygon counts as not convex. Corners
/// on a straight side are set back by rounding, in float32 files by up to some 10^-7.
constexpr double kDepth = 1e-6;

using Loop = std::vector<std::uint32_t>;  // corners by their number in the polygon

Loop cornersOf(std::span<const Triangle> fan) {
  Loop corners{fan[0][0], fan[0][1]};
  for (const Triangle& t : fan) corners.push_back(t[2]);
  return corners;
}

/// Twice the area along the normal.
glm::dvec3 newellNormal(const std::vector<glm::dvec3>& points) {
  glm::dvec3 normal(0);
  for (std::size_t i = 2; i < points.size(); ++i)
    normal += glm::cross(points[i - 1] - points[0], points[i] - points[0]);
  return normal;
}

/// `unit`: the Newell normal. All corners turn the same way, once around.
bool isConvex(const std::vector<glm::dvec3>& points, const glm::dvec3& unit) {
  const std::size_t n = points.size();
  double outline = 0;
  for (std::size_t i = 0; i < n; ++i) outline += glm::distance(points[i], points[(i + 1) % n]);
  const auto turnsBack = [&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 in = b - a, out = c - b;
    return glm::dot(glm::cross(in, out), unit) < -kDepth * outline * (glm::length(in) + glm::length(out));
  };
  for (std::size_t i = 0; i < n; ++i)
    if (turnsBack(points[i], points[(i + 1) % n], points[(i + 2) % n])) return false;
  for (std::size_t i = 2; i < n; ++i)
    if (turnsBack(points[0], points[i - 1], points[i])) return false;
  return true;
}

/// Seen from the normal's tip, so that the polygon turns to the left.
std::vector<std::array<double, 2>> project(const std::vector<glm::dvec3>& points, const glm::dvec3& unit) {
  const glm::dvec3 size = glm::abs(unit);
  const glm::dvec3 axis = size.x <= size.y && size.x <= size.z ? glm::dvec3(1, 0, 0)
                          : size.y <= size.z                   ? glm::dvec3(0, 1, 0)
                                                               : glm::dvec3(0, 0, 1);
  const glm::dvec3 u = glm::normalize(axis - unit * glm::dot(axis, unit)), v = glm::cross(unit, u);
  std::vector<std::array<double, 2>> flat;
  for (const glm::dvec3& p : points) flat.push_back({glm::dot(p, u), glm::dot(p, v)});
  return flat;
}

/// Takes the tips of spikes, sides walked out and back, out of `loop`, and gives their triangles, which have no area.
/// They would make earcut cover what lies outside.
std::vector<Triangle> takeSpikes(const std::vector<glm::dvec3>& points, Loop& loop) {
  std::vector<Triangle> triangles;
  const auto take = [&](std::size_t i) {
    const std::size_t n = loop.size();
    triangles.push_back({loop[(i + n - 1) % n], loop[i], loop[(i + 1) % n]});
    std::ranges::sort(triangles.back());
    loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(i));
  };
  for (std::size_t i = 0; i < loop.size() && loop.size() > 3; ++i) {
    const std::size_t n = loop.size();
    const glm::dvec3 before = points[loop[(i + n - 1) % n]], tip = points[loop[i]], after = points[loop[(i + 1) % n]];
    if (!(glm::dot(tip - before, after - tip) < 0 && glm::cross(tip - before, after - tip) == glm::dvec3(0))) continue;
    take(i);
    if (before == after && loop.size() > 3) take(i % loop.size());  // the corner that is there twice now
    i = static_cast<std::size_t>(-1);  // the corners beside it may be tips now
  }
  return triangles;
}

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// Earcut leaves out corners on straight lines, doubled corners, and what it cannot cut. All that is left of the
/// polygon then are regions between its sides and the triangles; a fan for each makes n - 2 triangles in all, since
/// every corner lies on the outline. Combinatorial: no coordinate is looked at.
void fillRest(std::vector<Triangle>& triangles, std::uint32_t n) {
  std::set<Edge> border;  // of the rest, which lies to the left
  for (std::uint32_t i = 0; i < n; ++i) border.insert({i, (i + 1) % n});
  for (const Triangle& t : triangles)
    for (const auto& [a, b] : {Edge{t[0], t[1]}, Edge{t[1], t[2]}, Edge{t[2], t[0]}})
      if (border.erase({a, b}) == 0) border.insert({b, a});
  while (!border.empty() && triangles.size() < n - 2) {
    Edge edge = *border.begin();
    Loop loop;
    do {
      border.erase(edge);
      loop.push_back(edge.first);
      const auto [a, b] = edge;
      // The next side of the region: of those that leave b, the first one to the right of the way back to a.
      auto next = border.lower_bound({b, a});
      if (next == border.begin() || std::prev(next)->first != b) next = border.lower_bound({b + 1, 0});
      if (next == border.begin() || std::prev(next)->first != b) break;
      edge = *std::prev(next);
    } while (edge.first != loop[0]);
    for (std::size_t i = 2; i < loop.size(); ++i) triangles.push_back({loop[0], loop[i - 1], loop[i]});
  }
}

}  // namespace

bool cutConcave(const std::vector<glm::dvec3>& positions, std::span<Triangle> fan) {
  const Loop corners = cornersOf(fan);
  std::vector<glm::dvec3> points;
  double size = 0;
  for (const std::uint32_t v : corners) {
    if (v >= positions.size()) return false;
    points.push_back(positions[v] - positions[corners[0]]);
    for (int axis = 0; axis < 3; ++axis) size = std::fmax(size, std::abs(points.back()[axis]));
  }
  if (!(size > 0 && std::isfinite(size))) return false;
  for (glm::dvec3& p : points) {
    if (!std::isfinite(p.x + p.y + p.z)) return false;
    p /= size;
  }
  const glm::dvec3 normal = newellNormal(points);
  const double length = glm::length(normal);
  if (!(length > 0)) {  // a bow tie of two equal halves, unless all corners lie on a line
    for (std::size_t i = 2; i < points.size(); ++i)
      if (glm::cross(points[i - 1], points[i]) != glm::dvec3(0)) return true;
    return false;
  }
  const glm::dvec3 unit = normal / length;
  if (isConvex(points, unit)) return false;

  Loop loop(corners.size());
  std::iota(loop.begin(), loop.end(), 0u);
  const std::vector<Triangle> spikes = takeSpikes(points, loop);
  std::vector<glm::dvec3> outline;
  for (const std::uint32_t corner : loop) outline.push_back(points[corner]);
  const auto indices = mapbox::earcut<std::uint32_t>(std::array{project(outline, unit)});
  std::vector<Triangle> triangles;
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    triangles.push_back({indices[i], indices[i + 1], indices[i + 2]});
    std::ranges::sort(triangles.back());  // in the polygon's order, and so with its orientation
  }
  fillRest(triangles, static_cast<std::uint32_t>(loop.size()));
  for (Triangle& t : triangles)
    for (std::uint32_t& corner : t) corner = loop[corner];
  triangles.insert(triangles.end(), spikes.begin(), spikes.end());
  if (triangles.size() != fan.size()) return true;  // the fan stays; see the tests for what it takes
  for (std::size_t i = 0; i < fan.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) fan[i][k] = corners[triangles[i][k]];
  return true;
}

}  // namespace tessera::datasets
