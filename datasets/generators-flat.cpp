// Pictures that fill the clip volume as they are: x and y from -1 to 1, y down, z from 0 (near) to 1. What hurts a
// rasteriser: shared edges at odd angles, slivers, overdraw, many triangles in one place.
#include <cmath>

#include "datasets/generators.h"
#include "datasets/random.h"

namespace tessera::datasets {
namespace {

constexpr double kPixel = 2.0 / 2048;  // sizes in pixels are those of a raster of 2048 x 2048

glm::vec3 point(const glm::dvec2& p, double z) { return {glm::vec2(p), static_cast<float>(z)}; }

void addLoose(Mesh& mesh, const glm::dvec2 (&corners)[3], double z) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const glm::dvec2& corner : corners) mesh.positions.push_back(point(corner, z));
  mesh.triangles.push_back({first, first + 1, first + 2});
}

Mesh makeGrid(const GeneratorValues& values) {
  const auto columns = static_cast<std::uint32_t>(values[0]), rows = static_cast<std::uint32_t>(values[1]);
  const glm::dvec2 turn = circlePoint(values[2] / 360);
  Mesh mesh;
  for (std::uint32_t row = 0; row <= rows; ++row) {
    for (std::uint32_t column = 0; column <= columns; ++column) {
      // Inside the screen at any angle: half the diagonal is 0.99.
      const glm::dvec2 p = (glm::dvec2(column, row) / glm::dvec2(columns, rows) * 2.0 - 1.0) * 0.7;
      mesh.positions.push_back(point({p.x * turn.x - p.y * turn.y, p.x * turn.y + p.y * turn.x}, 0.5));
      if (row == rows || column == columns) continue;
      const std::uint32_t a = row * (columns + 1) + column, b = a + 1, c = a + columns + 1, d = c + 1;
      mesh.triangles.push_back({a, c, b});
      mesh.triangles.push_back({b, c, d});
    }
  }
  return mesh;
}

Mesh makeFan(const GeneratorValues& values) {
  const auto count = static_cast<std::uint32_t>(values[0]);
  Mesh mesh;
  mesh.positions.push_back({0, 0, 0.25f});
  for (std::uint32_t i = 0; i < count; ++i) {
    mesh.positions.push_back(point(circlePoint(double(i) / count) * 0.95, 0.75));
    mesh.triangles.push_back({0, 1 + (i + 1) % count, 1 + i});
  }
  return mesh;
}

Mesh makeSlivers(const GeneratorValues& values) {
  const auto count = static_cast<std::uint32_t>(values[0]);
  // A strip between two nearly upright lines of points, turned a little so that no edge runs along the raster.
  const glm::dvec2 turn = circlePoint(0.01);
  Mesh mesh;
  for (std::uint32_t i = 0; i < count + 2; ++i) {
    const glm::dvec2 p((double(i) / (count + 1) * 2 - 1) * 0.9, i % 2 == 0 ? -0.9 : 0.9);
    mesh.positions.push_back(
        point({p.x * turn.x - p.y * turn.y, p.x * turn.y + p.y * turn.x}, 0.25 + 0.5 * i / (count + 1)));
    if (i < 2) continue;
    mesh.triangles.push_back(i % 2 == 0 ? Triangle{i - 2, i - 1, i} : Triangle{i - 1, i - 2, i});
  }
  return mesh;
}

/// Loose triangles with corners uniform in squares of side `side`: `place` gives a square's lowest corner.
template <class Place>
Mesh makeLoose(std::uint64_t count, double side, Random& random, Place place) {
  Mesh mesh;
  mesh.positions.reserve(count * 3);
  mesh.triangles.reserve(count);
  for (std::uint64_t i = 0; i < count; ++i) {
    const glm::dvec2 base = place();
    glm::dvec2 corners[3];
    for (glm::dvec2& corner : corners) {
      corner.x = base.x + side * random.unit();
      corner.y = base.y + side * random.unit();
    }
    addLoose(mesh, corners, random.unit());
  }
  return mesh;
}

Mesh makeSoup(const GeneratorValues& values) {
  // Three points uniform in a unit square span 11/144 on average (Henze, "Random triangles in convex
  // regions", J. Appl. Prob. 20, 1983).
  const double side = std::sqrt(values[1] * 144 / 11) * kPixel;
  Random random(static_cast<std::uint64_t>(values[2]));
  return makeLoose(static_cast<std::uint64_t>(values[0]), side, random, [&] {
    const double x = random.between(-1, 1), y = random.between(-1, 1);
    return glm::dvec2(x - side / 2, y - side / 2);
  });
}

Mesh makeHot(const GeneratorValues& values) {
  // Pixels [1024, 1024 + block) either way, which is one tile at 2048 x 2048 for blocks up to the tile's size.
  Random random(static_cast<std::uint64_t>(values[2]));
  return makeLoose(static_cast<std::uint64_t>(values[0]), values[1] * kPixel, random, [] { return glm::dvec2(0, 0); });
}

Mesh makeLayers(const GeneratorValues& values) {
  const auto count = static_cast<std::uint32_t>(values[0]);
  const bool nearFirst = values[1] != 0;
  Mesh mesh;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double z = (0.5 + (nearFirst ? i : count - 1 - i)) / count;
    for (const glm::dvec2 corner : {glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(-1, 1), glm::dvec2(1, 1)})
      mesh.positions.push_back(point(corner, z));
    mesh.triangles.push_back({4 * i, 4 * i + 2, 4 * i + 1});
    mesh.triangles.push_back({4 * i + 1, 4 * i + 2, 4 * i + 3});
  }
  return mesh;
}

}  // namespace

std::vector<Generator> flatGenerators() {
  const GeneratorParameter seed{"seed", 1, 0, 0x1p53};
  return {
      {"grid",
       "flat: 2 x columns x rows triangles that share edges, turned by an angle in degrees",
       {{"columns", 64, 1, 2048}, {"rows", 64, 1, 2048}, {"angle", 0, 0, 360, false}},
       true,
       makeGrid},
      {"fan", "flat: a closed fan of count triangles around the centre", {{"count", 1000, 3, 4000000}}, true, makeFan},
      {"slivers",
       "flat: a strip of count triangles over the whole height",
       {{"count", 2000, 1, 4000000}},
       true,
       makeSlivers},
      {"soup",
       "flat: count loose triangles of a mean area in pixels at 2048 x 2048, corners and depths at random",
       {{"count", 100000, 1, 10000000}, {"pixels", 64, 0.01, 1000000, false}, seed},
       true,
       makeSoup},
      {"layers",
       "flat: count times the whole screen, two triangles each",
       {{"count", 64, 1, 100000}, {"order", 0, 0, 1, true, {"far-to-near", "near-to-far"}}},
       true,
       makeLayers},
      {"hot",
       "flat: count triangles in one block of block x block pixels at 2048 x 2048",
       {{"count", 500000, 1, 10000000}, {"block", 64, 1, 2048, false}, seed},
       true,
       makeHot},
  };
}

}  // namespace tessera::datasets
