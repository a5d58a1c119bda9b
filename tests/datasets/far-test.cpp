// Scenes far from 0: one origin a scene is taken from double coordinates before they are rounded.
#include <fmt/format.h>
#include <tessera/oracle.h>

#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "datasets/camera.h"
#include "datasets/extent.h"
#include "fixture.h"
#include "host/frame/lighting.h"
#include "tests/support/streams.h"

using namespace tessera;
using namespace tessera::test;

namespace {

const glm::dvec3 kFar(500000, -4500000, 1e7);  // multiples of 4, the power of two above the sphere's diagonal

/// A sphere whose coordinates are multiples of 2^-20, so that moving it is exact in double.
Mesh sphere(const char* spec = "icosphere?level=2") {
  Mesh mesh = generateMesh(spec);
  for (glm::dvec3& p : mesh.positions) p = glm::round(p * 0x1p20) * 0x1p-20;
  return mesh;
}

std::string off(const Mesh& mesh, const glm::dvec3& by) {
  std::string text = fmt::format("OFF\n{} {} 0\n", mesh.positions.size(), mesh.triangles.size());
  for (const glm::dvec3& p : mesh.positions) text += fmt::format("{} {} {}\n", p.x + by.x, p.y + by.y, p.z + by.z);
  for (const Triangle& t : mesh.triangles) text += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
  return text;
}

std::string obj(const Mesh& mesh, const glm::dvec3& by) {
  std::string text;
  for (const glm::dvec3& p : mesh.positions) text += fmt::format("v {} {} {}\n", p.x + by.x, p.y + by.y, p.z + by.z);
  for (const Triangle& t : mesh.triangles) text += fmt::format("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  return text;
}

std::string ply(const Mesh& mesh, const glm::dvec3& by) {
  std::string text = fmt::format(
      "ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      mesh.positions.size(), mesh.triangles.size());
  return text +
         off(mesh, by).substr(fmt::format("OFF\n{} {} 0\n", mesh.positions.size(), mesh.triangles.size()).size());
}

std::string stl(const Mesh& mesh, const glm::dvec3& by) {
  std::string text = "solid\n";
  for (const Triangle& t : mesh.triangles) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const std::uint32_t v : t) {
      const glm::dvec3 p = mesh.positions[v] + by;
      text += fmt::format("vertex {} {} {}\n", p.x, p.y, p.z);
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid\n";
}

std::string plyFloat32(const Mesh& mesh, const glm::dvec3& by) {
  std::string text = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      mesh.positions.size(), mesh.triangles.size());
  const auto put = [&](const auto& value) { text.append(reinterpret_cast<const char*>(&value), sizeof value); };
  for (const glm::dvec3& p : mesh.positions) put(glm::vec3(p + by));
  for (const Triangle& t : mesh.triangles) {
    put(std::uint8_t{3});
    put(t);
  }
  return text;
}

/// All that a frame depends on: the same bits.
void checkSame(const Scene& scene, const Scene& other) {
  const auto bits = [](std::span<const glm::vec3> values) {
    std::vector<std::array<std::uint32_t, 3>> all;
    for (const glm::vec3& v : values) all.push_back(std::bit_cast<std::array<std::uint32_t, 3>>(v));
    return all;
  };
  CHECK(bits(scene.positions) == bits(other.positions));
  CHECK(bits(std::span<const glm::vec3>(normalsOf(scene))) == bits(std::span<const glm::vec3>(normalsOf(other))));
  CHECK(scene.triangles == other.triangles);
  CHECK(std::bit_cast<std::array<std::uint32_t, 16>>(scene.clipFromObject) ==
        std::bit_cast<std::array<std::uint32_t, 16>>(other.clipFromObject));
  const frame::Lighting light = frame::lightingOf(scene.clipFromObject),
                        otherLight = frame::lightingOf(other.clipFromObject);
  CHECK(light.light == otherLight.light);
  CHECK(light.eye == otherLight.eye);
}

std::string triple(const glm::dvec3& v) { return fmt::format("[{}, {}, {}]", v.x, v.y, v.z); }

}  // namespace

TEST_CASE("The origin: 0 near 0 and else the box's centre to a multiple of the power of two above its diagonal") {
  const auto origin = [](const glm::dvec3& low, const glm::dvec3& high) { return datasets::originOf({low, high}); };
  CHECK(datasets::originOf({}) == glm::dvec3(0));
  CHECK(origin({-1, -1, -1}, {1, 1, 1}) == glm::dvec3(0));
  // A box of diagonal 3 whose centre is just within twice that, and just beyond; the power of two is 4.
  CHECK(origin({6 - 1, -1, -0.5}, {6 + 1, 1, 0.5}) == glm::dvec3(0));
  CHECK(origin({6.25 - 1, -1, -0.5}, {6.25 + 1, 1, 0.5}) == glm::dvec3(8, 0, 0));
  CHECK(origin({-101, 99, 1}, {-99, 101, 2}) == glm::dvec3(-100, 100, 0));
  // Above means above: a diagonal of 4 has 8. Halves go up, so that a move by a multiple changes nothing.
  CHECK(origin({100, 0, 0}, {104, 0, 0}) == glm::dvec3(104, 0, 0));
  CHECK(origin({-110, 0, 0}, {-106, 0, 0}) == glm::dvec3(-104, 0, 0));
  CHECK(origin({98, 0, 0}, {102, 0, 0}) == glm::dvec3(104, 0, 0));
  CHECK(origin({-102, 0, 0}, {-98, 0, 0}) == glm::dvec3(-96, 0, 0));
  // One point, and boxes so far out that a double has no more room for the power.
  CHECK(origin({3, 4, 5}, {3, 4, 5}) == glm::dvec3(3, 4, 5));
  CHECK(origin({1e30, 0, 0}, {1e30, 1, 0}) == glm::dvec3(1e30, 0, 0));
  CHECK(origin({-1e308, 0, 0}, {1.5e308, 1, 0}) == glm::dvec3(0));
}

TEST_CASE("A mesh far from 0 has the bits of the mesh with the move taken out") {
  const Files files;
  const Mesh mesh = sphere();
  using Writer = std::string (*)(const Mesh&, const glm::dvec3&);
  for (const auto& [name, write] :
       {std::pair<std::string, Writer>{"off", off}, {"obj", obj}, {"ply", ply}, {"stl", stl}}) {
    INFO(name);
    const Scene here = loadInput(files.write("here." + name, write(mesh, glm::dvec3(0))), 300, 200);
    const Scene far = loadInput(files.write("far." + name, write(mesh, kFar)), 300, 200);
    CHECK(here.origin == glm::dvec3(0));
    CHECK(far.origin == kFar);
    CHECK(far.notes.empty());
    checkSame(far, here);
    CHECK(sceneHash(far) != sceneHash(here));  // what is said of it is not the same
  }
  // What C++ appends is never moved.
  Scene built;
  Mesh moved = mesh;
  for (glm::dvec3& p : moved.positions) p += kFar;
  append(built, moved);
  CHECK(built.origin == glm::dvec3(0));
  CHECK(built.positions[7] == glm::vec3(moved.positions[7]));
}

TEST_CASE("A scene far from 0 with its camera has the bits of the scene with the move taken out") {
  const Files files;
  files.write("here.off", off(sphere(), glm::dvec3(0)));
  files.write("far.off", off(sphere(), kFar));
  // The second mesh is moved by its matrix, which turns it, too; the third one is far in its file and brought back.
  const auto text = [&](const char* mesh, const glm::dvec3& by, const std::string& camera) {
    return fmt::format(
        "[[mesh]]\nsource = \"{0}\"\n[[mesh]]\nsource = \"here.off\"\nmatrix = [0.6,-0.8,0,{1}, 0.8,0.6,0,{2}, "
        "0,0,1,{3}, "
        "0,0,0,1]\n[[mesh]]\nsource = \"far.off\"\nmatrix = [0.3,0,0,{4}, 0,0.3,0,{5}, 0,0,0.3,{6}, 0,0,0,1]\n{7}",
        mesh, by.x + 1, by.y, by.z, by.x - 0.3 * kFar.x, by.y - 0.3 * kFar.y, by.z - 0.3 * kFar.z, camera);
  };
  const auto eye = [](const glm::dvec3& by) {
    return fmt::format("[camera]\neye = {}\ntarget = {}\n", triple(by + glm::dvec3(1, 2.5, 6)),
                       triple(by + glm::dvec3(0.5, 0, 0)));
  };
  // Halves and quarters, so that M translate(-T) and back is exact.
  const auto matrix = [](const glm::dvec3& by) {
    return fmt::format("[camera]\nmatrix = [0.5,0,0,{}, 0,-0.5,0.25,{}, 0,0,0.25,{}, 0,0,0,1]\n", -0.5 * by.x,
                       0.5 * by.y - 0.25 * by.z, 0.5 - 0.25 * by.z);
  };
  for (const auto& camera :
       {std::function<std::string(const glm::dvec3&)>(eye), {matrix}, {[](const glm::dvec3&) { return ""; }}}) {
    const Scene here = loadInput(files.write("here.toml", text("here.off", glm::dvec3(0), camera(glm::dvec3(0)))));
    const Scene far = loadInput(files.write("far.toml", text("far.off", kFar, camera(kFar))));
    CHECK(here.origin == glm::dvec3(0));
    CHECK(far.origin == kFar);
    CHECK(far.notes.empty());
    checkSame(far, here);
  }
}

TEST_CASE("A flat generator that a matrix takes away is seen by its own clip volume still") {
  const Files files;
  const Scene scene = loadInput(files.write(
      "a.toml", "[[mesh]]\nsource = \"generate:grid\"\nmatrix = [1,0,0,4096, 0,1,0,0, 0,0,1,0, 0,0,0,1]\n"));
  CHECK(scene.origin == glm::dvec3(4096, 0, 0));
  CHECK(scene.clipFromObject[3] == 4096);
  REQUIRE(scene.notes.size() == 1);
  CHECK(scene.notes[0].ends_with("a.toml: the camera sees nothing: all triangles lie right of the picture"));
}

// (b) of any move. Each coordinate that enters clip space differs from the true one by at most u |q| (its rounding, u =
// 2^-24), each entry of the matrix by u |m|, and the transform adds three sums and three products: together at most 6 u
// S with S = sum |m| |q| + |m3|, to first order, and 7 u S with all higher ones. So x / w and y / w are off by at most
// (7 u S_x + |x / w| 7 u S_w) / (w - 7 u S_w), and the four roundings of the projection by 4 u (1 + |x / w|) more, in
// units of half the raster's extent; snapping adds half a 1/256 pixel. A triangle's edges move by no more than its
// corners do, so each sample whose coverage changes between two pictures lies within the sum of both bounds, d, of an
// edge.
namespace {

struct Seen {
  std::vector<glm::dvec2> corners;  ///< pixels
  double bound = 0;                 ///< pixels
};

Seen seen(const Scene& scene) {
  const double u = 0x1p-24;
  Seen result;
  const Matrix& m = scene.clipFromObject;
  for (const glm::vec3& q : scene.positions) {
    const auto row = [&](std::size_t r, bool sizes) {
      const auto term = [&](double a) { return sizes ? std::abs(a) : a; };
      return term(double(m[r]) * q.x) + term(double(m[r + 1]) * q.y) + term(double(m[r + 2]) * q.z) + term(m[r + 3]);
    };
    const double w = row(12, false), eW = 7 * u * row(12, true);
    glm::dvec2 at, off;
    for (int axis = 0; axis < 2; ++axis) {
      const double ratio = row(axis == 0 ? 0 : 4, false) / w;
      const double half = 0.5 * (axis == 0 ? scene.width : scene.height);
      at[axis] = (ratio + 1) * half;
      off[axis] = half * ((7 * u * row(axis == 0 ? 0 : 4, true) + std::abs(ratio) * eW) / (w - eW) +
                          4 * u * (1 + std::abs(ratio))) +
                  1.0 / 512;
    }
    result.corners.push_back(at);
    result.bound = std::fmax(result.bound, glm::length(off));
  }
  return result;
}

double distanceToSegment(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
  const double part = std::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
  return glm::distance(p, a + (b - a) * part);
}

/// Differing samples between two pictures of one scene, each of which must lie within the bound of an edge.
int checkNear(const Scene& here, const Scene& far) {
  const auto a = oracle::render(here).image.ids, b = oracle::render(far).image.ids;
  const Seen from = seen(here), to = seen(far);
  const double bound = from.bound + to.bound;
  CHECK(bound < 0.02);
  int differing = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] == b[i]) continue;
    ++differing;
    const glm::dvec2 sample(double(i % here.width) + 0.5, double(i / here.width) + 0.5);
    double nearest = 1e9;
    for (const Triangle& t : here.triangles)
      for (std::size_t k = 0; k < 3; ++k)
        nearest = std::fmin(nearest, distanceToSegment(sample, from.corners[t[k]], from.corners[t[(k + 1) % 3]]));
    CHECK(nearest <= bound);
  }
  return differing;
}

}  // namespace

TEST_CASE("Moved anywhere a scene differs only where a sample nearly touches an edge") {
  const Files files;
  const Mesh mesh = sphere("icosphere?level=5");
  int differing = 0;
  for (const glm::dvec3 by :
       {glm::dvec3(500000.3, 4500000.7, 12.1), {1e7 + 0.1, 0, -1e7 / 3}, {0, 77.7, 0}, {-3e9, 1, 2}}) {
    const auto text = [&](const std::string& name, const glm::dvec3& move) {
      files.write(name + ".off", off(mesh, move));
      return files.write(
          name + ".toml",
          fmt::format("size = [900, 700]\n[[mesh]]\nsource = \"{}.off\"\n[camera]\neye = {}\ntarget = {}\n", name,
                      triple(move + glm::dvec3(0.5, 1, 3)), triple(move)));
    };
    const Scene here = loadInput(text("here", glm::dvec3(0))), far = loadInput(text("far", by));
    CHECK(far.origin != glm::dvec3(0));
    differing += checkNear(here, far);
  }
  CHECK(differing > 0);  // or the bound would not have been looked at
}

TEST_CASE("A grid at UTM coordinates covers what the same grid covers near 0") {
  const Files files;
  Mesh grid;
  for (std::uint32_t row = 0; row < 33; ++row)
    for (std::uint32_t column = 0; column < 33; ++column) {
      grid.positions.emplace_back(column, row, (row * 7 + column * 5) % 3);
      if (row == 32 || column == 32) continue;
      const std::uint32_t a = row * 33 + column;
      grid.triangles.push_back({a, a + 1, a + 33});
      grid.triangles.push_back({a + 1, a + 34, a + 33});
    }
  const auto draw = [&](const std::string& path) { return oracle::render(loadInput(path, 256, 256)).image.ids; };
  const auto here = draw(files.write("here.off", off(grid, glm::dvec3(0))));
  const auto far = draw(files.write("far.off", off(grid, glm::dvec3(500000, 4500000, 0))));
  const auto float32 = draw(files.write("float32.ply", plyFloat32(grid, glm::dvec3(500000, 4500000, 0))));
  const auto differing = [&](const auto& other) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < here.size(); ++i) count += here[i] != other[i];
    return count;
  };
  CHECK(far == float32);  // whole numbers: exact in float32 as well
  CHECK(differing(far) < here.size() / 1000);
}

TEST_CASE("A coordinate as an attribute is the input's, rounded once") {
  const Files files;
  files.write("far.off", off(sphere(), kFar));
  const std::string path = files.write("a.toml",
                                       "[[mesh]]\nsource = \"far.off\"\n[[mesh]]\nsource = \"far.off\"\nmatrix = "
                                       "[1,0,0,0.25, 0,1,0,0, 0,0,1,0, 0,0,0,1]\n");
  const Mesh mesh = sphere();
  for (const int axis : {0, 1, 2}) {
    const std::string name(1, static_cast<char>('x' + axis));
    const Scene scene = loadInput(path, 0, 0, {name, {}});
    REQUIRE(attributeOf(scene).size() == 2 * mesh.positions.size());
    CHECK(attributeName(scene) == name);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      CHECK(attributeOf(scene)[v] == float(mesh.positions[v][axis] + kFar[axis]));
      CHECK(attributeOf(scene)[mesh.positions.size() + v] ==
            float(mesh.positions[v][axis] + kFar[axis] + (axis == 0 ? 0.25 : 0)));
    }
  }
}

TEST_CASE("A replay of a far scene is the same picture") {
  const Files files;
  const Scene scene = loadInput(files.write("far.off", off(sphere(), kFar)), 100, 80, {"x", {}});
  writeReplay(files.path("far.replay"), scene);
  const Scene back = loadInput(files.path("far.replay"));
  CHECK(attributeOf(back) == attributeOf(scene));
  CHECK(back.clip == oracle::transform(scene));
}

TEST_CASE("How coarse float32 is for an input is said where it matters") {
  const Files files;
  const Mesh mesh = sphere();
  const auto notes = [](const std::string& path) { return loadInput(path).notes; };
  CHECK(notes(files.write("near.ply", plyFloat32(mesh, glm::dvec3(0)))).empty());
  CHECK(notes(files.write("ten.ply", plyFloat32(mesh, glm::dvec3(10, 0, 0)))).empty());
  const auto far = notes(files.write("far.ply", plyFloat32(mesh, glm::dvec3(1e7, 0, 0))));
  REQUIRE(far.size() == 1);
  CHECK(far[0].starts_with(files.path("far.ply") +
                           ": the file's coordinates of up to 1e+07 are rounded to float32 by up to 0.5, "));
  // A text has them in double; but meshes far apart share one origin.
  CHECK(notes(files.write("far.off", off(mesh, glm::dvec3(1e7, 0, 0)))).empty());
  files.write("here.off", off(mesh, glm::dvec3(0)));
  const std::string path = files.write("a.toml", "[[mesh]]\nsource = \"far.off\"\n[[mesh]]\nsource = \"here.off\"\n");
  const auto apart = notes(path);
  REQUIRE(apart.size() == 1);
  CHECK(apart[0].starts_with(
      path + ": far.off: coordinates, less the scene's origin, of up to 1e+07 are rounded to float32 by up to 0.5, "));
}
