// Every mesh that comes with the project, and some that are hard to write, through the writers of a second library and
// back: the same triangles, in every bit that a format keeps.
#include <fmt/format.h>
#include <tessera/input.h>

#include <bit>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <map>

#include "host/support/files.h"
#include "host/support/subprocess.h"

using namespace tessera;

namespace {

Mesh hardMesh() {
  Mesh mesh;
  mesh.positions = {{0.1, -0.0, 1.0 / 3},
                    {1e7 + 0.125, 1e-30, -2},
                    {3.0e-44, 16777217, 5e5},
                    {0.1, 0.1, 0.1},
                    {-7, -1e30, 4503599627370497}};
  // Twice the same, a corner twice, on its back, three at an edge, and a vertex that no face uses.
  mesh.triangles = {{0, 1, 2}, {0, 1, 2}, {1, 1, 3}, {2, 1, 0}, {0, 1, 3}, {3, 2, 0}};
  return mesh;
}

std::map<std::string, Mesh> meshes() {
  std::map<std::string, Mesh> all{{"hard", hardMesh()}};
  for (const GeneratorDoc& doc : generatorDocs()) {
    const std::string& name = doc.name;
    const bool many = name == "soup" || name == "hot" || name == "slivers" || name == "fan";
    all[name] = generateMesh(name + (many                  ? "?count=300"
                                     : name == "icosphere" ? "?level=2"
                                     : name == "torus"     ? "?rings=12&sides=8"
                                     : name == "grid"      ? "?columns=12&rows=9&angle=31"
                                                           : "?count=9"));
  }
  return all;
}

enum class Kept { kDouble, kFloat32, kEightDigits };

/// What is left of a coordinate in a format.
double kept(double value, Kept how) {
  if (how == Kept::kDouble) return value;
  if (how == Kept::kFloat32) return static_cast<float>(value);
  return static_cast<float>(std::strtod(fmt::format("{:.8f}", static_cast<float>(value)).c_str(), nullptr));
}

}  // namespace

TEST_CASE("What a second library writes comes back as the same triangles") {
  const support::TemporaryFolder folder(std::filesystem::temp_directory_path(), "round-trip-test");
  const auto all = meshes();
  for (const auto& [name, mesh] : all) {
    std::ofstream file(folder.path() / (name + ".mesh"), std::ios::binary);
    const std::uint64_t counts[] = {mesh.positions.size(), mesh.triangles.size()};
    file.write(reinterpret_cast<const char*>(counts), sizeof counts);
    file.write(reinterpret_cast<const char*>(mesh.positions.data()),
               static_cast<std::streamsize>(mesh.positions.size() * sizeof(glm::dvec3)));
    file.write(reinterpret_cast<const char*>(mesh.triangles.data()),
               static_cast<std::streamsize>(mesh.triangles.size() * sizeof(Triangle)));
  }
  const support::ProcessResult result = support::runProcess({PYTHON, WRITER, folder.path().string()});
  if (!result.ok()) FAIL(result.output);

  // STL has no vertices of its own, and trimesh's STL and PLY are of float32; its text of PLY has eight digits, of
  // properties that say float.
  const std::map<std::string, Kept> files{{".obj", Kept::kDouble},
                                          {"-normals.obj", Kept::kDouble},
                                          {".off", Kept::kDouble},
                                          {"-text.stl", Kept::kDouble},
                                          {".stl", Kept::kFloat32},
                                          {"-float32.ply", Kept::kFloat32},
                                          {"-float32-text.ply", Kept::kEightDigits},
                                          {"-text.ply", Kept::kDouble},
                                          {"-little.ply", Kept::kDouble},
                                          {"-big.ply", Kept::kDouble},
                                          {"-strange-text.ply", Kept::kDouble},
                                          {"-strange-little.ply", Kept::kDouble},
                                          {"-strange-big.ply", Kept::kDouble},
                                          {"-list-text.ply", Kept::kDouble},
                                          {"-list-little.ply", Kept::kDouble}};
  for (const auto& [name, mesh] : all)
    for (const auto& [ending, how] : files) {
      INFO(name << ending);
      const Mesh back = readMesh(folder.path() / (name + ending));
      REQUIRE(back.triangles.size() == mesh.triangles.size());
      std::size_t wrong = 0;
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) {
          const glm::dvec3 &is = back.positions.at(back.triangles[t][k]), &was = mesh.positions[mesh.triangles[t][k]];
          for (int axis = 0; axis < 3; ++axis)
            wrong += std::bit_cast<std::uint64_t>(is[axis]) != std::bit_cast<std::uint64_t>(kept(was[axis], how));
        }
      CHECK(wrong == 0);
      if (ending.ends_with("stl") || ending == "-normals.obj") continue;  // corners may share vertices, or have twins
      CHECK(back.triangles == mesh.triangles);
      CHECK(back.positions.size() == mesh.positions.size());
    }
}
