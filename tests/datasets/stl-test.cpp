#include <cstring>

#include "fixture.h"

using namespace tessera;

namespace {

const std::string kText = R"(solid a thing
facet normal 0 0 1
  outer loop
    vertex 0 0 0
    vertex 1 0 0
    vertex 0 1 0
  endloop
endfacet
FACET NORMAL 0 0 1
  OUTER LOOP
    VERTEX 0 0 0
    VERTEX 0 0 0
    VERTEX 0 1 0
  ENDLOOP
ENDFACET
facet normal 0 0 1
  outer loop
    vertex 0 1 0
    vertex 1 0 0
    vertex 1 1 1e-39
  endloop
endfacet
endsolid a thing
)";
const std::vector<Triangle> kExpected{{0, 1, 2}, {0, 0, 2}, {2, 1, 3}};

std::string binary(const Mesh& mesh, std::uint32_t count) {
  std::string text(80, '\0');
  std::memcpy(text.data(), "solid", 5);  // as many programs write it
  const auto put = [&](const auto& value) { text.append(reinterpret_cast<const char*>(&value), sizeof value); };
  put(count);
  for (const Triangle& t : mesh.triangles) {
    put(glm::vec3(0));
    for (const std::uint32_t v : t) put(glm::vec3(mesh.positions[v]));
    put(std::uint16_t{0});
  }
  return text;
}

}  // namespace

TEST_CASE("STL: text and binary, degenerate facets in their places, corners shared by their bits alone") {
  const Files files;
  const Mesh mesh = readMesh(files.write("a.stl", kText));
  CHECK(mesh.triangles == kExpected);
  REQUIRE(mesh.positions.size() == 4);
  CHECK(mesh.positions[3].z > 0);
  const Mesh other = readMesh(files.write("b.stl", binary(mesh, 3)));
  CHECK(other.triangles == kExpected);
  CHECK(other.positions == mesh.positions);
}

TEST_CASE("STL: broken files are refused where they are broken") {
  const Files files;
  const Mesh mesh = readMesh(files.write("good.stl", kText));
  CHECK(readError(files, "a.stl", "") == "a.stl: is empty");
  CHECK(readError(files, "a.stl", "hello").starts_with("a.stl: neither STL text"));
  CHECK(readError(files, "a.stl", binary(mesh, 4)).starts_with("a.stl: neither STL text"));
  CHECK(readError(files, "a.stl", binary(mesh, 3).substr(0, 150)).starts_with("a.stl: neither STL text"));
  CHECK(readError(files, "a.stl", kText.substr(0, kText.find("endsolid"))).ends_with("the file ends before endsolid"));
  CHECK(readError(files, "a.stl", kText.substr(0, 80)).starts_with("a.stl:5: "));
  std::string two = kText;
  two.erase(two.find("    vertex 0 1 0\n"), 17);
  CHECK(readError(files, "a.stl", two) == "a.stl:6: a facet has 2 vertices; 3 would be right");
  std::string nan = kText;
  nan.replace(nan.find("vertex 1"), 8, "vertex nan");
  CHECK(readError(files, "a.stl", nan).starts_with("a.stl:5: vertex x: 'nan'"));
}
