#include <glm/geometric.hpp>

#include "fixture.h"

using namespace tessera;

namespace {
const std::string kFour = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
}

TEST_CASE("OBJ: faces that repeat a corner keep their places") {
  const Files files;
  const Mesh mesh = readMesh(files.write("a.obj", "# x\nmtllib none.mtl\n" + kFour + R"(usemtl red
f 1 2 3
f 1 1 2
f 1 2 3 4
f 1/1 2/1/1 2/2 3
f 3 3 3
f 1 2 3
)"));
  const std::vector<Triangle> expected{{0, 1, 2}, {0, 0, 1}, {0, 1, 2}, {0, 2, 3},
                                       {0, 1, 1}, {0, 1, 2}, {2, 2, 2}, {0, 1, 2}};
  CHECK(mesh.triangles == expected);
  CHECK(mesh.positions.size() == 4);
}

TEST_CASE("OBJ: negative, zero and far indices; faces before their vertices; continued lines") {
  const Files files;
  const Mesh mesh = readMesh(files.write("a.obj", "f 1 2 3\n" + kFour +
                                                      "f -1 -2 \\\n -3\nf 0 1 2\nf 1 5 2\nf 1 -5 2\n"
                                                      "f 1 2 99999999999\nf 0 9 1 # two at once\n"));
  const std::uint32_t bad = kBadIndex;
  const std::vector<Triangle> expected{{0, 1, 2},   {3, 2, 1},   {bad, 0, 1},  {0, bad, 1},
                                       {0, bad, 1}, {0, 1, bad}, {bad, bad, 0}};
  CHECK(mesh.triangles == expected);
}

TEST_CASE("OBJ: a vertex that faces give several normals has a twin for each") {
  const Files files;
  const Mesh mesh = readMesh(files.write("a.obj", kFour + "vn 0 0 2\nvn 1 0 0\nf 1//1 2//1 3//1\nf 1//2 3//2 4//2\n"
                                                          "f 1//1 3//2 4//2\nf 1//1 2//1 9//1\n"));
  REQUIRE(mesh.triangles.size() == 4);
  REQUIRE(mesh.positions.size() == 6);
  REQUIRE(mesh.normals.size() == 6);
  const glm::vec3 z(0, 0, 1), x(1, 0, 0);
  const std::vector<std::vector<glm::vec3>> expected{{z, z, z}, {x, x, x}, {z, x, x}};
  for (std::size_t t = 0; t < 3; ++t)
    for (std::size_t k = 0; k < 3; ++k) CHECK(mesh.normals[mesh.triangles[t][k]] == expected[t][k]);
  CHECK(mesh.positions[mesh.triangles[1][0]] == mesh.positions[mesh.triangles[0][0]]);
  CHECK(mesh.triangles[3] == Triangle{0, 1, kBadIndex});  // twins do not bring it into range
}

TEST_CASE("OBJ: normals are computed where the file has none") {
  const Files files;
  // Two triangles of areas 1/2 and 2 that meet at a right angle along x: the second weighs four times as much.
  const Mesh mesh = readMesh(files.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 4\nv 9 9 9\nf 1 2 3\nf 2 1 4\n"));
  const glm::vec3 both = glm::normalize(glm::vec3(0, 4, 1));
  for (std::size_t v = 0; v < 2; ++v) CHECK(glm::distance(mesh.normals[v], both) < 1e-6f);
  CHECK(mesh.normals[2] == glm::vec3(0, 0, 1));
  CHECK(mesh.normals[3] == glm::vec3(0, 1, 0));
  CHECK(mesh.normals[4] == glm::vec3(0, 0, 1));  // in no triangle
}

TEST_CASE("OBJ: broken files are refused where they are broken") {
  const Files files;
  CHECK(readError(files, "a.obj", "") == "a.obj: is empty");
  CHECK(readError(files, "a.obj", "hello\nworld\n").starts_with("a.obj:2: no vertex"));
  CHECK(readError(files, "a.obj", kFour + "v 1 2\n").starts_with("a.obj:5: vertex (v x y z) is missing"));
  CHECK(readError(files, "a.obj", kFour + "v 1 2 x\n").starts_with("a.obj:5: vertex (v x y z): 'x'"));
  CHECK(readError(files, "a.obj", kFour + "v 1 inf 2\n").starts_with("a.obj:5: vertex (v x y z): 'inf'"));
  CHECK(readError(files, "a.obj", kFour + "f 1 2\n") == "a.obj:5: a face has fewer than 3 corners");
  CHECK(readError(files, "a.obj", kFour + "f 1 2 /3\n").starts_with("a.obj:5: corner '/3'"));
  CHECK(readError(files, "a.obj", kFour + "f 1 2 3d\n").starts_with("a.obj:5: corner '3d'"));
}
