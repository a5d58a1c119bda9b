#include "datasets/notes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include "datasets/extent.h"

namespace tessera::datasets {
namespace {

/// A rounding is worth a line from this part of the mean edge on: where triangles are as large as pixels, it is the
/// part of a pixel that vertices snap to.
constexpr double kWorthALine = 1.0 / 256;

/// What rounding to float32 moves a number of this size by, at most: half of its last place.
double halfUlp(double size) {
  return size == 0 ? 0 : std::ldexp(1.0, std::max(std::ilogb(size), std::numeric_limits<float>::min_exponent - 1) - 24);
}

struct Rounding {
  double largest = 0;   ///< coordinate
  double meanEdge = 0;  ///< of the drawn triangles

  double relative() const { return meanEdge > 0 ? halfUlp(largest) / meanEdge : 0; }
};

template <class Point>
Rounding roundingOf(const Point* positions, const std::vector<Triangle>& triangles, const std::vector<bool>& drawn) {
  Rounding rounding;
  double sum = 0;
  std::size_t edges = 0;
  for (const auto& t : triangles) {
    if (!std::ranges::all_of(t, [&](std::uint32_t v) { return v < drawn.size() && drawn[v]; })) continue;
    const glm::dvec3 corners[] = {glm::dvec3(positions[t[0]]), glm::dvec3(positions[t[1]]),
                                  glm::dvec3(positions[t[2]])};
    for (std::size_t k = 0; k < 3; ++k) {
      for (int axis = 0; axis < 3; ++axis) rounding.largest = std::fmax(rounding.largest, std::abs(corners[k][axis]));
      sum += glm::distance(corners[k], corners[(k + 1) % 3]);
      ++edges;
    }
  }
  if (edges != 0) rounding.meanEdge = sum / static_cast<double>(edges);
  return rounding;
}

/// Why nothing of a mesh can be seen, or nothing.
std::string whyNothing(const Mesh& mesh, const std::vector<bool>& drawn) {
  const std::size_t vertices = mesh.positions.size(), triangles = mesh.triangles.size();
  if (triangles == 0)
    return vertices == 0 ? "no vertices and no triangles" : fmt::format("no triangles: {} points only", vertices);
  if (std::ranges::find(drawn, true) != drawn.end()) return "";
  const auto isFinite = [&](std::uint32_t v) { return v < vertices && withinFloat32(mesh.positions[v]); };
  if (std::ranges::any_of(mesh.triangles, [&](const Triangle& t) { return std::ranges::all_of(t, isFinite); }))
    return fmt::format("none of its {} triangles has an area", triangles);
  return fmt::format(
      "none of its {} triangles can be drawn: each has an index out of range or a coordinate that is not finite",
      triangles);
}

}  // namespace

void noteMesh(Scene& scene, const PlacedMesh& placed, const std::vector<bool>& drawn, std::size_t first) {
  const Mesh& mesh = placed.mesh;
  for (const std::string& note : mesh.notes) scene.notes.push_back(fmt::format("{}: {}", placed.name, note));
  if (const std::string why = whyNothing(mesh, drawn); !why.empty()) {
    scene.notes.push_back(fmt::format("{}: {}", placed.name, why));
    scene.unseen = true;
    return;
  }
  const auto beyond = std::ranges::count_if(mesh.triangles, [&](const Triangle& t) {
    return std::ranges::any_of(t, [&](std::uint32_t v) { return v >= mesh.positions.size(); });
  });
  if (beyond != 0)
    scene.notes.push_back(fmt::format("{}: {} of {} triangles {} an index out of range and {} not drawn", placed.name,
                                      beyond, mesh.triangles.size(), beyond == 1 ? "has" : "have",
                                      beyond == 1 ? "is" : "are"));
  const Rounding file = mesh.float32 ? roundingOf(mesh.positions.data(), mesh.triangles, drawn) : Rounding{};
  const Rounding ours = roundingOf(scene.positions.data() + first, mesh.triangles, drawn);
  const bool files = file.relative() >= ours.relative();
  const Rounding& rounding = files ? file : ours;
  if (!(rounding.relative() >= kWorthALine)) return;
  scene.notes.push_back(
      fmt::format("{}: {} up to {:.4g} are rounded to float32 by up to {:.2g}, {:.2g}% of the mean edge of {:.2g}",
                  placed.name, files ? "the file's coordinates of" : "coordinates, less the scene's origin, of",
                  rounding.largest, halfUlp(rounding.largest), 100 * rounding.relative(), rounding.meanEdge));
}

void noteUnseen(Scene& scene, const std::string& file) {
  constexpr std::array kWhere{"behind the eye",      "in front of the near plane", "beyond the far plane",
                              "left of the picture", "right of the picture",       "above the picture",
                              "below the picture"};
  std::array<bool, kWhere.size()> all;
  all.fill(true);
  const auto drawn = drawnVertices(scene.positions.size(), scene.triangles.span(),
                                   [&](std::size_t v) { return glm::dvec3(scene.positions[v]); });
  bool any = false;
  for (std::size_t v = 0; v < drawn.size(); ++v) {
    if (!drawn[v]) continue;
    any = true;
    const Matrix& m = scene.clipFromObject;
    const glm::dvec3 p(scene.positions[v]);
    const auto row = [&](std::size_t r) { return m[r] * p.x + m[r + 1] * p.y + m[r + 2] * p.z + m[r + 3]; };
    const double x = row(0), y = row(4), z = row(8), w = row(12);
    const std::array<bool, kWhere.size()> outside{w <= 0, z<0, z> w, x<-w, x> w, y<-w, y> w};
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = all[i] && outside[i];
    if (std::ranges::find(all, true) == all.end()) return;
  }
  if (!any) return;
  const auto where = static_cast<std::size_t>(std::ranges::find(all, true) - all.begin());
  scene.unseen = true;
  scene.notes.push_back(fmt::format("{}: the camera sees nothing: all triangles lie {}", file, kWhere[where]));
}

}  // namespace tessera::datasets
