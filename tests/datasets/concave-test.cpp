// Polygons as triangles: a fan where they are convex, ear clipping where they are not, n - 2 triangles in any case.
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "fixture.h"

using namespace tessera;
using namespace tessera::test;

namespace {

using Points = std::vector<glm::dvec3>;

std::string offOf(const Points& points) {
  std::string text = "OFF\n" + std::to_string(points.size()) + " 3 0\n";
  char line[128];
  for (const glm::dvec3& p : points) {
    std::snprintf(line, sizeof line, "%.17g %.17g %.17g\n", p.x, p.y, p.z);
    text += line;
  }
  std::string polygon = std::to_string(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) polygon += " " + std::to_string(i);
  return text + "3 0 1 2\n" + polygon + "\n3 2 1 0\n";  // ids before and behind stay where they are
}

struct Cut {
  std::vector<Triangle> triangles;
  std::uint64_t concave;
};
Cut cut(const Files& files, const Points& points) {
  const Mesh mesh = readMesh(files.write("a.off", offOf(points)));
  const std::size_t n = points.size();
  REQUIRE(mesh.triangles.size() == n);
  CHECK(mesh.triangles.front() == Triangle{0, 1, 2});
  CHECK(mesh.triangles.back() == Triangle{2, 1, 0});
  CHECK(mesh.notes.empty() == (mesh.concavePolygons == 0));
  return {{mesh.triangles.begin() + 1, mesh.triangles.end() - 1}, mesh.concavePolygons};
}

std::vector<Triangle> fanOf(std::size_t n) {
  std::vector<Triangle> fan;
  for (std::uint32_t i = 2; i < n; ++i) fan.push_back({0, i - 1, i});
  return fan;
}

glm::dvec3 areaOf(const Points& p, const Triangle& t) { return glm::cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]); }

glm::dvec3 newell(const Points& points) {
  glm::dvec3 sum(0);
  for (const Triangle& t : fanOf(points.size())) sum += areaOf(points, t);
  return sum;
}

/// All triangles turn like the polygon, and their areas make up the polygon's: nothing is covered twice, nothing is
/// left.
void checkCovers(const Points& points, const std::vector<Triangle>& triangles) {
  const glm::dvec3 normal = newell(points), unit = glm::normalize(normal);
  double area = 0;
  for (const Triangle& t : triangles) {
    const double part = glm::dot(areaOf(points, t), unit);
    CHECK(part >= -1e-9 * glm::length(normal));
    area += std::abs(part);
  }
  CHECK(area == Approx(glm::length(normal)).epsilon(1e-9));
}

/// Into the plane through a point, spanned by two directions.
Points lift(const Points& flat, glm::dvec3 origin, glm::dvec3 u, glm::dvec3 v) {
  Points points;
  for (const glm::dvec3& p : flat) points.push_back(origin + u * p.x + v * p.y);
  return points;
}

const Points kArrow{{0, 0, 0}, {4, -3, 0}, {1, 0, 0}, {4, 3, 0}};
const Points kL{{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}};

}  // namespace

TEST_CASE("Convex polygons keep their fan") {
  const Files files;
  for (const std::size_t n : {3u, 4u, 5u, 8u, 100u}) {
    Points points;
    for (std::size_t i = 0; i < n; ++i) {
      const double angle = 6.283185307179586 * double(i) / double(n);
      points.push_back({std::cos(angle), 0.3 * std::sin(angle), std::cos(angle) + 2 * std::sin(angle)});
    }
    const Cut whole = cut(files, points);
    CHECK(whole.triangles == fanOf(n));
    CHECK(whole.concave == 0);
    // Corners on straight sides, as far as their digits reach.
    Points more;
    for (std::size_t i = 0; i < n; ++i) {
      more.push_back(points[i]);
      for (const double t : {0.1, 1 / 3.0})
        more.push_back(glm::vec3(points[i] + t * (points[(i + 1) % n] - points[i])));
    }
    const Cut finer = cut(files, more);
    CHECK(finer.triangles == fanOf(3 * n));
    CHECK(finer.concave == 0);
  }
}

TEST_CASE("Concave polygons are covered once, whichever corner they begin with and wherever they lie") {
  const Files files;
  for (const Points& flat : {kArrow, kL}) {
    for (const auto& [origin, u, v] : {std::array<glm::dvec3, 3>{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},
                                       {{{5, 5, 5}, {0, 1, 0}, {1, 0, 0}}},
                                       {{{0, 0, 1}, {0, 0, 1}, {1, 0, 0}}},
                                       {{{1, 2, 3}, {0.6, 0.8, 0.1}, {-0.3, 0.2, 0.9}}},
                                       {{{500000, 4500000, 100}, {1, 0, 0.5}, {0, 1, 0.25}}},
                                       {{{0, 0, 0}, {1e-6, 0, 0}, {0, 1e-6, 0}}}}) {
      Points points = lift(flat, origin, u, v);
      for (std::size_t turn = 0; turn < points.size(); ++turn) {
        const Cut result = cut(files, points);
        CHECK(result.concave == 1);
        checkCovers(points, result.triangles);
        std::rotate(points.begin(), points.begin() + 1, points.end());
      }
    }
  }
  CHECK(readMesh(files.write("a.obj", "v 0 0 0\nv 4 -3 0\nv 1 0 0\nv 4 3 0\nf 1 2 3 4\n")).triangles ==
        std::vector<Triangle>{{0, 2, 3}, {0, 1, 2}});
}

TEST_CASE("Random star-shaped polygons are covered once") {
  const Files files;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> radius(0.2, 1);
  for (int round = 0; round < 60; ++round) {
    const std::size_t n = 4 + std::size_t(round) * 3;  // with the z-order curve of large ones, too
    Points flat;
    for (std::size_t i = 0; i < n; ++i) {
      const double angle = 6.283185307179586 * double(i) / double(n), r = radius(random);
      flat.push_back({r * std::cos(angle), r * std::sin(angle), 0});
    }
    const Points points = lift(flat, {1, 2, 3}, {0.6, 0.8, 0.1}, {-0.3, 0.2, 0.9});
    INFO("round " << round);
    checkCovers(points, cut(files, points).triangles);
  }
}

TEST_CASE("Concave polygons with corners on straight sides, doubled corners and bridges are covered once") {
  const Files files;
  Points sides;
  for (std::size_t i = 0; i < kL.size(); ++i)
    for (const double t : {0.0, 0.25, 0.5}) sides.push_back(kL[i] + t * (kL[(i + 1) % kL.size()] - kL[i]));
  checkCovers(sides, cut(files, sides).triangles);
  Points doubled;
  for (const glm::dvec3& p : kL) doubled.insert(doubled.end(), 2, p);
  checkCovers(doubled, cut(files, doubled).triangles);
  // A square with a square hole, joined by a bridge that is passed twice.
  const Points ring{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0},
                    {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}, {1, 1, 0}};
  const Cut result = cut(files, ring);
  CHECK(result.concave == 1);
  checkCovers(ring, result.triangles);
}

TEST_CASE("A side that is walked out and back covers nothing, whichever corner the polygon begins with") {
  const Files files;
  const std::vector<Points> polygons{
      {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {3, 1.25, 0}, {2, 1, 0}, {2, 2, 0}, {0, 2, 0}},          // on a side
      {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {3, 3, 0}, {2, 2, 0}, {0, 2, 0}},                        // at a corner
      {{0, 0, 0}, {4, 0, 0}, {4, 1, 0}, {1, 1, 0}, {3, 3, 0}, {1, 1, 0}, {1, 4, 0}, {0, 4, 0}},  // into a notch
      {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {3, 1, 0}, {4, 1, 0}, {3, 1, 0}, {2, 1, 0}, {2, 2, 0}, {0, 2, 0}}};
  for (Points points : polygons) {
    for (std::size_t turn = 0; turn < points.size(); ++turn) {
      std::rotate(points.begin(), points.begin() + 1, points.end());
      INFO("turned by " << turn << " of " << points.size());
      const Cut result = cut(files, points);
      CHECK(result.concave == 1);
      checkCovers(points, result.triangles);
    }
  }
}

TEST_CASE("Each corner of a polygon that is cut stays in a triangle, in the polygon's order") {
  const Files files;
  Points sides;
  for (std::size_t i = 0; i < kL.size(); ++i)
    for (const double t : {0.0, 0.5}) sides.push_back(kL[i] + t * (kL[(i + 1) % kL.size()] - kL[i]));
  std::vector<int> uses(sides.size());
  for (const Triangle& t : cut(files, sides).triangles) {
    CHECK((t[0] < t[1] && t[1] < t[2]));
    for (const std::uint32_t v : t) ++uses[v];
  }
  for (const int use : uses) CHECK(use > 0);
}

TEST_CASE("Polygons of any kind give n - 2 triangles") {
  const Files files;
  const double nan = std::nan(""), inf = INFINITY;
  (void)nan, (void)inf;
  const std::vector<Points> strange{
      {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}},                                 // crosses itself
      {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {1.5, 0, 0}},                    // on one line
      {{1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3}},                                 // one point
      {{0, 1, 0}, {0.6, -0.8, 0}, {-0.9, 0.3, 0}, {0.9, 0.3, 0}, {-0.6, -0.8, 0}},  // a pentagram
      {{0, 0, 0}, {2, 0, 0}, {1, 0, 0}, {2, 1, 0}, {2, 0, 0}, {0, 2, 0}},           // spikes
      {{0, 0, 0}, {1, 0, 1}, {1, 1, -1}, {0, 1, 1}, {0.2, 0.5, -3}},                // far from flat
      {{0, 0, 0}, {1e200, 0, 0}, {1e199, 1e199, 0}, {0, 1e200, 0}},
  };
  for (const Points& points : strange) {
    const std::size_t n = points.size();
    Mesh mesh;
    mesh.positions = points;
    const std::vector<Triangle> fan = fanOf(n);
    std::string text =
        "ply\nformat ascii 1.0\nelement vertex " + std::to_string(n) +
        "\nproperty double x\nproperty double y\nproperty double z\nelement face 1\nproperty list int int "
        "vertex_indices\nend_header\n";
    char line[128];
    for (const glm::dvec3& p : points) {
      std::snprintf(line, sizeof line, "%.17g %.17g %.17g\n", p.x, p.y, p.z);
      text += line;
    }
    text += std::to_string(n);
    for (std::size_t i = 0; i < n; ++i) text += " " + std::to_string(i);
    CHECK(readMesh(files.write("a.ply", text)).triangles.size() == n - 2);
  }
  // No plane: the fan stays, and is not counted.
  const std::string four = "v 0 0 0\nv 4 -3 0\nv 1 0 0\nv 4 3 0\n";
  const Mesh mesh = readMesh(files.write("a.obj", four + "f 2 3 4 9\nf 1 1 1 1\nf 2 3 4 1\nf 1 2 3 4\n"));
  CHECK(mesh.triangles.size() == 8);
  CHECK(mesh.triangles[0] == Triangle{1, 2, 3});
  CHECK(mesh.triangles[1] == Triangle{1, 3, kBadIndex});
  CHECK(mesh.triangles[3] == Triangle{0, 0, 0});
  CHECK(mesh.concavePolygons == 2);
}

TEST_CASE("Random nonsense polygons give n - 2 triangles with the corners in order") {
  const Files files;
  std::mt19937 random(11);
  std::uniform_int_distribution<int> coordinate(0, 3), size(4, 40);
  for (int round = 0; round < 300; ++round) {
    Points points(static_cast<std::size_t>(size(random)));
    for (glm::dvec3& p : points) p = {coordinate(random), coordinate(random), 0};
    INFO("round " << round);
    for (const Triangle& t : cut(files, points).triangles) CHECK((t[0] < t[1] && t[1] < t[2]));
  }
}

TEST_CASE("A concave polygon keeps the normals that its corners have in OBJ") {
  const Files files;
  const Mesh mesh = readMesh(files.write("a.obj",
                                         "v 0 0 0\nv 4 -3 0\nv 1 0 0\nv 4 3 0\nvn 0 0 1\nvn 1 0 0\nvn 0 1 0\n"
                                         "f 1//1 2//1 3//1\nf 2//2 3//3 4//2 1//3\n"));
  CHECK(mesh.concavePolygons == 1);
  REQUIRE(mesh.triangles.size() == 3);
  for (std::size_t t = 1; t < 3; ++t)
    for (const std::uint32_t v : mesh.triangles[t]) {
      const glm::dvec3 p = mesh.positions[v];
      CHECK(mesh.normals[v] == (p.x == 4 ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0)));
    }
}
