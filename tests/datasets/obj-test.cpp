#include <cmath>
#include <glm/geometric.hpp>

#include "fixture.h"

using namespace tessera;
using namespace tessera::test;

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

TEST_CASE(
    "OBJ: statements that have no triangles are skipped, curves and surfaces are named, other words are refused") {
  const Files files;
  const std::string skipped =
      "vt 0 0\nvp 0 0\no a\ng b c\ns off\nmg 0\nusemtl red # 1\nmtllib a b.mtl\nl 1 2\np 1\nbevel on\nlod 3\n"
      "c_interp on\nd_interp on\nshadow_obj x\ntrace_obj x\ncstype bezier\ndeg 3\nparm u 0 1\nend\n";
  const Mesh plain = readMesh(files.write("a.obj", kFour + skipped + "f 1 2 3\n"));
  CHECK(plain.triangles == std::vector<Triangle>{{0, 1, 2}});
  CHECK(plain.notes.empty());
  const Mesh curves =
      readMesh(files.write("a.obj", kFour + "surf 0 1 0 1 1 2 3 4\ncurv 0 1 1 2\nsurf 0 1 0 1 1 2 3 4\n"));
  CHECK(curves.triangles.empty());
  CHECK(curves.notes == std::vector<std::string>{"statements that are not read: 1 curv, 2 surf"});
  for (const std::string word : {"fo", "F", "V", "face", "vertex", "f1", "\xef\xbb\xbfv", "1", "\\"})
    CHECK(readError(files, "a.obj", kFour + word + " 1 2 3\n")
              .starts_with("a.obj:5: '" + word + "' is no statement of OBJ"));
}

TEST_CASE("OBJ: a vertex may have a weight, a colour or both") {
  const Files files;
  const Mesh mesh =
      readMesh(files.write("a.obj", "v 1 2 3 0.5\nv 4 5 6 0.1 0.2 0.3\nv 7 8 10 1 0.1 0.2 0.3\nf 1 2 3\n"));
  CHECK(mesh.positions == std::vector<glm::dvec3>{{1, 2, 3}, {4, 5, 6}, {7, 8, 10}});
  CHECK(readError(files, "a.obj", "v 1 2 3 4 5\n").starts_with("a.obj:1: a vertex has 5 numbers"));
  CHECK(readError(files, "a.obj", "v 1 2 3 red\n").starts_with("a.obj:1: vertex (v x y z): 'red'"));
}

TEST_CASE("OBJ: negative normals count from the last one so far; corners in each form") {
  const Files files;
  const Mesh mesh = readMesh(files.write("a.obj", kFour + "vn 0 0 1\nf 1//-1 2//-1 3//-1\nvn 1 0 0\nvt 0 0\n"
                                                          "f 1/1/-1 3/-1/-1 4/1/-1\nf 1/ 2// 3/1/\n"));
  REQUIRE(mesh.triangles.size() == 3);
  for (int k = 0; k < 3; ++k) CHECK(mesh.normals[mesh.triangles[0][k]] == glm::vec3(0, 0, 1));
  for (int k = 0; k < 3; ++k) CHECK(mesh.normals[mesh.triangles[1][k]] == glm::vec3(1, 0, 0));
  CHECK(mesh.triangles[2] == Triangle{0, 1, 2});
}

TEST_CASE("OBJ: normals that are not there are counted") {
  const Files files;
  for (const std::string normal : {"7", "0", "-2", "99999999999"}) {
    const std::string n = "//" + normal;
    const Mesh mesh = readMesh(files.write("a.obj", kFour + "vn 0 0 1\nf 1" + n + " 2" + n + " 3//1\n"));
    INFO(normal);
    REQUIRE(mesh.notes.size() == 1);
    CHECK(mesh.notes[0] == "2 corners of triangles without the normal that the file names: it is computed");
  }
}

TEST_CASE("OBJ: a name that ends in a backslash takes no statement with it") {
  const Files files;
  const Mesh mesh = readMesh(
      files.write("a.obj", kFour + "usemtl C:\\mats\\\nf 1 2 3\ng a \\\n b\ng \\\r\n  f 1 3 4\np 1 2 \\\n3\n"));
  CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
}

TEST_CASE("OBJ: coordinates keep the double that is nearest to their digits") {
  const Files files;
  const Mesh mesh = readMesh(files.write(
      "a.obj",
      "v 4500000.123 .5 -5.\nv 0.1234567890123456789 1e22 1.7976931348623157e-290\nv +1e-400 9007199254740993 -0\n"
      "v 123456789012345678901234567890e-20 1E+5 0e9999\nf 1 2 3\n"));
  CHECK(mesh.positions[0] == glm::dvec3(4500000.123, 0.5, -5));
  CHECK(mesh.positions[1] == glm::dvec3(0.1234567890123456789, 1e22, 1.7976931348623157e-290));
  CHECK(mesh.positions[2] == glm::dvec3(0, 9007199254740992, 0));
  CHECK(std::signbit(mesh.positions[2].z));
  CHECK(mesh.positions[3] == glm::dvec3(1234567890.1234567890, 1e5, 0));
}

TEST_CASE("OBJ: broken files are refused where they are broken") {
  const Files files;
  CHECK(readError(files, "a.obj", "") == "a.obj: is empty");
  CHECK(readError(files, "a.obj", "g a\n#f 1 2 3\n").starts_with("a.obj:1: no vertex"));
  CHECK(readError(files, "a.obj", kFour + "v 1 2\n").starts_with("a.obj:5: vertex (v x y z) is missing"));
  CHECK(readError(files, "a.obj", kFour + "v 1 2 x\n").starts_with("a.obj:5: vertex (v x y z): 'x'"));
  CHECK(readError(files, "a.obj", kFour + "v 1 inf 2\n").starts_with("a.obj:5: vertex (v x y z): 'inf'"));
  CHECK(readError(files, "a.obj", kFour + "f 1 2\n") == "a.obj:5: a face has fewer than 3 corners");
  CHECK(readError(files, "a.obj", kFour + "f 1 2 /3\n").starts_with("a.obj:5: corner '/3'"));
  CHECK(readError(files, "a.obj", kFour + "f 1 2 3d\n").starts_with("a.obj:5: corner '3d'"));
  CHECK(readError(files, "a.obj", kFour + "f\n") == "a.obj:5: a face has fewer than 3 corners");
  CHECK(readError(files, "a.obj", kFour + "f 1 2/x 3\n").starts_with("a.obj:5: corner '2/x'"));
  CHECK(readError(files, "a.obj", kFour + "f 1 2//x 3\n").starts_with("a.obj:5: corner '2//x'"));
  CHECK(readError(files, "a.obj", kFour + "f 1 2//1/1 3\n").starts_with("a.obj:5: corner '2//1/1'"));
  CHECK(readError(files, "a.obj", kFour + "v 1 1e39 2\n").starts_with("a.obj:5: vertex (v x y z): '1e39'"));
}
