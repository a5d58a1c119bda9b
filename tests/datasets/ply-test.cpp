#include <cmath>
#include <cstring>
#include <limits>

#include "fixture.h"

using namespace tessera;
using namespace tessera::test;

namespace {

std::string header(const std::string& format, const std::string& vertices, const std::string& faces,
                   const std::string& more = "") {
  return "ply\nformat " + format + " 1.0\ncomment made here\nelement vertex " + vertices +
         "\nproperty float x\nproperty float y\nproperty float z\n" + more + "element face " + faces +
         "\nproperty list uchar int vertex_indices\nend_header\n";
}

template <class T>
void put(std::string& out, T value, bool big = false) {
  char bytes[sizeof value];
  std::memcpy(bytes, &value, sizeof value);
  if (big) std::reverse(bytes, bytes + sizeof value);
  out.append(bytes, sizeof value);
}

std::string binary(bool big, float strange = 0) {
  std::string text = header(big ? "binary_big_endian" : "binary_little_endian", "4", "3");
  for (const float c : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 1.f, 1.f, strange, 0.f, 1.f, 0.f}) put(text, c, big);
  for (const auto& face : std::vector<std::vector<int>>{{0, 1, 2, 3}, {0, 0, 1}, {0, 1, 9}}) {
    put(text, static_cast<unsigned char>(face.size()));
    for (const int v : face) put(text, v, big);
  }
  return text;
}

const std::vector<Triangle> kExpected{{0, 1, 2}, {0, 2, 3}, {0, 0, 1}, {0, 1, kBadIndex}};

}  // namespace

TEST_CASE("PLY: text and both byte orders give the same mesh") {
  const Files files;
  const std::string text = header("ascii", "4", "3") + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n3 0 0 1\n3 0 1 9";
  const Mesh mesh = readMesh(files.write("a.ply", text));
  CHECK(mesh.triangles == kExpected);
  for (const bool big : {false, true}) {
    const Mesh other = readMesh(files.write("b.ply", binary(big)));
    CHECK(other.triangles == kExpected);
    CHECK(other.positions == mesh.positions);
  }
}

TEST_CASE("PLY: coordinates of binary files may be infinite or NaN") {
  const Files files;
  const Mesh mesh = readMesh(files.write("a.ply", binary(false, std::numeric_limits<float>::quiet_NaN())));
  CHECK(std::isnan(mesh.positions[2].z));
  CHECK(mesh.triangles == kExpected);
  for (const glm::vec3& n : mesh.normals) CHECK(std::isfinite(n.x + n.y + n.z));
  for (const float m : loadInput(files.path("a.ply")).clipFromObject) CHECK(std::isfinite(m));
}

TEST_CASE("PLY: normals and further scalars are taken, later elements left alone") {
  const Files files;
  const std::string more = "property float nx\nproperty float ny\nproperty float nz\nproperty uchar quality\n";
  std::string text = header("ascii", "3", "1", more);
  text.insert(text.find("end_header"), "element edge 1\nproperty list uchar int ends\n");
  const Mesh mesh =
      readMesh(files.write("a.ply", text + "0 0 0 2 0 0 7\n1 0 0 0 2 0 7\n0 1 0 0 0 0 7\n3 0 1 2\n2 0 1\n"));
  REQUIRE(mesh.normals.size() == 3);
  CHECK(mesh.normals[0] == glm::vec3(1, 0, 0));
  CHECK(mesh.normals[1] == glm::vec3(0, 1, 0));
  CHECK(mesh.normals[2] == glm::vec3(0, 0, 1));
}

TEST_CASE("PLY: broken files are refused where they are broken") {
  const Files files;
  const std::string good = header("ascii", "3", "1") + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  CHECK(readMesh(files.write("good.ply", good)).triangles.size() == 1);
  CHECK(readError(files, "a.ply", "") == "a.ply: is empty");
  CHECK(readError(files, "a.ply", "plx\n").starts_with("a.ply:1: 'ply' would be right"));
  CHECK(readError(files, "a.ply", good.substr(0, good.find("end_header"))).find("the file ends before end_header") !=
        std::string::npos);
  CHECK(readError(files, "a.ply", good.substr(0, good.size() - 4)) ==
        "a.ply:14: the file ends early, in vertex_indices of face 0");
  CHECK(readError(files, "a.ply", header("ascii", "3", "1") + "0 0 0\nnil 0 0\n0 1 0\n3 0 1 2\n") ==
        "a.ply:12: x: 'nil' is not a number");
  CHECK(readError(files, "a.ply", header("ascii", "3", "9000") + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2") ==
        "a.ply:14: the file ends early, in face");
  CHECK(readError(files, "a.ply", good + "3 0 1 2\n").starts_with("a.ply:15: '3' is left after the last element"));
  const std::string whole = binary(false);
  CHECK(readError(files, "a.ply", whole.substr(0, whole.size() - 3)).find("the file ends early") != std::string::npos);
  CHECK(readError(files, "a.ply", whole + "x").find("1 bytes are left") != std::string::npos);
  const auto changed = [&](std::string_view from, std::string_view to) {
    std::string text = good;
    return readError(files, "a.ply", text.replace(text.find(from), from.size(), to));
  };
  CHECK(changed("ascii", "asci").starts_with("a.ply:2: format ascii, "));
  CHECK(changed("format ascii 1.0\n", "") == "a.ply:9: no format; 'format ascii 1.0' or a binary one would be right");
  CHECK(changed("element vertex 3\n", "") == "a.ply:4: a property before the first element");
  CHECK(changed("property float z\n", "").starts_with("a.ply:9: element 'vertex' has no property 'z'"));
  CHECK(changed("comment", "commend").starts_with("a.ply:3: 'commend' where format, element"));
  CHECK(changed("float y", "float y y").starts_with("a.ply:6: 'y' where the line's end"));
  CHECK(changed("face 1", "face -1").starts_with("a.ply:8: count of the element: '-1'"));
  CHECK(changed("3 0 1 2", "-3 0 1 2").starts_with("a.ply:14: vertex_indices: '-3' is not a whole number from 0"));
  CHECK(changed("3 0 1 2", "300 0 1 2").starts_with("a.ply:14: vertex_indices: '300' is not a whole number from 0"));
  CHECK(changed("3 0 1 2", "3 0 1.5 2") == "a.ply:14: vertex_indices: '1.5' is not a whole number");
  CHECK(changed("property float x", "property flout x") == "a.ply:5: 'flout' is not a type of PLY");
  CHECK(changed("property float y", "property float x") == "a.ply:6: property 'x' is there twice");
  CHECK(changed("element face 1", "element vertex 1") == "a.ply:8: element 'vertex' is there twice");
  CHECK(changed("property list uchar int", "property int").find("'vertex_indices' is not a list") != std::string::npos);
  CHECK(changed("vertex_indices", "indices") == "a.ply:10: element 'face' has no list 'vertex_indices'");
}
