#include <sys/stat.h>

#include <cstring>
#include <fstream>
#include <thread>

#include "datasets/mesh-formats.h"
#include "fixture.h"

using namespace tessera;
using namespace tessera::test;

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
  for (std::size_t v = 0; v < 4; ++v) CHECK(glm::vec3(other.positions[v]) == glm::vec3(mesh.positions[v]));
}

TEST_CASE("STL: text is read by words, not by lines") {
  const Files files;
  const Mesh expected = readMesh(files.write("a.stl", kText));
  std::string line = kText, words = kText, dense;
  line.replace(line.find(" a thing"), 8, "");
  for (char& c : line)
    if (c == '\n') c = ' ';
  for (char& c : words)
    if (c == ' ') c = '\n';
  words.replace(words.find("a\nthing"), 7, "facet thing");
  words.replace(words.find("solid\n"), 6, "solid ");
  words.replace(words.find("endsolid\na\nthing"), 16, "endsolid a thing");
  for (const std::string& text : {line, words, "\n\t " + kText, "\xef\xbb\xbf" + kText, " \r\n" + line}) {
    INFO(text);
    const Mesh mesh = readMesh(files.write("b.stl", text));
    CHECK(mesh.triangles == kExpected);
    CHECK(mesh.positions == expected.positions);
  }
  std::string capitals = kText;
  for (char& c : capitals)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  CHECK(readMesh(files.write("b.stl", capitals)).triangles == kExpected);
  std::string normal = kText;
  CHECK(readMesh(files.write("b.stl", normal.replace(normal.find("0 0 1"), 5, "nan -inf 1e99"))).triangles ==
        kExpected);
}

TEST_CASE("STL: several solids in a file, and solids with no facet") {
  const Files files;
  for (const std::string& text : {kText + kText, kText + "\n\n" + kText, kText + "solid\nendsolid\n" + kText}) {
    const Mesh mesh = readMesh(files.write("a.stl", text));
    std::vector<Triangle> twice = kExpected;
    twice.insert(twice.end(), kExpected.begin(), kExpected.end());
    CHECK(mesh.triangles == twice);
    CHECK(mesh.positions.size() == 4);
  }
  const std::string one = "facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet ";
  CHECK(readMesh(files.write("a.stl", "solid a " + one + "endsolid a solid b " + one + one + "endsolid b"))
            .triangles.size() == 3);
  CHECK(readMesh(files.write("a.stl", "solid\nendsolid\n")).triangles.empty());
  CHECK(readMesh(files.write("a.stl", "solid my solid\n" + one + "endsolid my solid\n")).triangles.size() == 1);
}

TEST_CASE("STL: a binary file may hold any header, none, or what text holds") {
  const Files files;
  const Mesh mesh = readMesh(files.write("a.stl", kText));
  std::string bytes = binary(mesh, 3);
  for (const std::string header : {"solid a\nfacet normal", " solid", "\xff\xfe", "\xef\xbb\xbfsolid"}) {
    bytes.replace(0, header.size(), header);
    CHECK(readMesh(files.write("b.stl", bytes)).triangles == kExpected);
  }
  CHECK(readMesh(files.write("b.stl", std::string(84, '\0'))).triangles.empty());
  CHECK(readError(files, "b.stl", bytes + "x").starts_with("b.stl: neither STL text"));
}

TEST_CASE("STL: a binary file of several pieces, from a disk and from a pipe") {
  const Files files;
  const Mesh mesh = generateMesh("icosphere?level=6");
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  const std::string bytes = binary(mesh, count), path = files.write("a.stl", bytes), pipe = files.path("pipe.stl");
  const auto check = [&](const Mesh& read) {
    CHECK(read.positions.size() == mesh.positions.size());
    REQUIRE(read.triangles.size() == count);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < count; ++i)
      for (int k = 0; k < 3; ++k)
        wrong += glm::vec3(read.positions[read.triangles[i][static_cast<std::size_t>(k)]]) !=
                 glm::vec3(mesh.positions[mesh.triangles[i][static_cast<std::size_t>(k)]]);
    CHECK(wrong == 0);
  };
  std::vector<std::uint64_t> at;
  check(readMesh(path, {}, [&](std::uint64_t done, std::uint64_t all) {
    CHECK(all == bytes.size());
    at.push_back(done);
  }));
  CHECK(at.size() > 10);
  CHECK(std::ranges::is_sorted(at));
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  const std::jthread writer([&] { std::ofstream(pipe, std::ios::binary) << bytes; });
  check(readMesh(pipe));
}

TEST_CASE("STL: a binary file that becomes shorter while it is read") {
  const Files files;
  const Mesh mesh = readMesh(files.write("a.stl", kText));
  const std::string path = files.write("b.stl", binary(mesh, 3));
  datasets::InputFile file(path);
  std::filesystem::resize_file(path, 200);
  CHECK(usageError([&] { datasets::readStl(file, {}); }) == path + ": became shorter while it was read");
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
  CHECK(readError(files, "a.stl", two) == "a.stl:6: a facet has fewer than 3 vertices; 3 would be right");
  std::string nan = kText;
  nan.replace(nan.find("vertex 1"), 8, "vertex nan");
  CHECK(readError(files, "a.stl", nan).starts_with("a.stl:5: vertex x: 'nan'"));
  const auto changed = [&](std::string_view from, std::string_view to) {
    std::string text = kText;
    return readError(files, "a.stl", text.replace(text.find(from), from.size(), to));
  };
  CHECK(changed("endloop", "") == "a.stl:8: 'endfacet' where endloop would be right");
  CHECK(changed("endfacet", "") == "a.stl:9: 'FACET' where endfacet would be right");
  CHECK(changed("outer loop", "loop") == "a.stl:3: 'loop' where outer would be right");
  CHECK(changed("normal 0 0 1", "normal 0 0") == "a.stl:3: normal of a facet: 'outer' is not a number");
  CHECK(changed("  endloop", "vertex 1 2 3\nendloop") == "a.stl:7: a facet has more than 3 vertices; 3 would be right");
  CHECK(changed("endsolid a thing\n", "endsolid\nmore\n") == "a.stl:24: 'more' where solid would be right");
}
