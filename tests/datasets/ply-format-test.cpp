// What the format of PLY allows, in text and both byte orders: each file here has the same two triangles.
#include <cmath>
#include <limits>

#include "fixture.h"
#include "ply-writer.h"
#include "tests/support/streams.h"

using namespace tessera;
using namespace tessera::test;

namespace {

const std::vector<glm::dvec3> kPositions{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
const std::vector<Triangle> kTriangles{{0, 1, 2}, {0, 2, 3}};
const std::string kBegin = "ply\nformat FORMAT 1.0\n";
const std::string kVertices = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
const std::string kFaces = "element face 2\nproperty list uchar int vertex_indices\n";

void putVertices(PlyData& data, std::string_view type = "float") {
  for (const glm::dvec3& p : kPositions) data.put(type, p.x).put(type, p.y).put(type, p.z);
}
void putFaces(PlyData& data, std::string_view count = "uchar", std::string_view index = "int") {
  for (const Triangle& t : kTriangles) data.list(count, index, {double(t[0]), double(t[1]), double(t[2])});
}
void checkMesh(const Files& files, const std::string& text) {
  const Mesh mesh = readMesh(files.write("a.ply", text));
  CHECK(mesh.positions == kPositions);
  CHECK(mesh.triangles == kTriangles);
}
/// The two triangles under a header, whose data are the plain ones.
void checkHeader(const Files& files, const std::string& header) {
  for (const std::string& format : kPlyFormats) {
    INFO(format << "\n" << header);
    PlyData data(format);
    putVertices(data);
    putFaces(data);
    checkMesh(files, data.file(header));
  }
}

}  // namespace

TEST_CASE("PLY: comments anywhere in the header, blanks at its lines' ends") {
  const Files files;
  checkHeader(files, kBegin + kVertices + kFaces + "end_header\n");
  checkHeader(files, kBegin + kVertices + kFaces + "comment the last line\nend_header\n");
  checkHeader(files, kBegin + kVertices + kFaces + "obj_info element face 9\nend_header\n");
  checkHeader(files, "ply\ncomment end_header\nobj_info 1\nformat FORMAT 1.0\n" + kVertices + "comment\n" + kFaces +
                         "end_header\n");
  checkHeader(files, kBegin + kVertices + kFaces + "end_header \t\n");
  checkHeader(files, "ply \nformat  FORMAT\t1.0 \n" + kVertices + "\n" + kFaces + " end_header\n");
}

TEST_CASE("PLY: the three line ends in the header, before binary data that begin with a line feed, too") {
  const Files files;
  const std::string header = kBegin + "comment x\n" + kVertices + kFaces + "end_header\n";
  for (const std::string end : {"\r", "\r\n"}) {
    std::string other;
    for (const char c : header) c == '\n' ? other += end : other += c;
    checkHeader(files, other);
    for (const std::string format : {"binary_little_endian", "binary_big_endian"}) {
      PlyData data(format);
      for (int v = 0; v < 3; ++v) data.put("uchar", 10).put("uchar", v == 1).put("uchar", v == 2);
      data.list("uchar", "uchar", {0, 1, 2});
      std::string bytes =
          "ply\nformat FORMAT 1.0\nelement vertex 3\nproperty uchar x\nproperty uchar y\nproperty uchar z\n"
          "element face 1\nproperty list uchar uchar vertex_index\nend_header\n";
      for (std::size_t at = 0; (at = bytes.find('\n', at)) != bytes.npos; at += end.size()) bytes.replace(at, 1, end);
      const Mesh mesh = readMesh(files.write("b.ply", data.file(bytes)));
      REQUIRE(mesh.positions.size() == 3);
      CHECK(mesh.positions[0] == glm::dvec3(10, 0, 0));
      CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}});
    }
  }
  // Mixed, and a byte order mark.
  checkHeader(files, "ply\r\nformat FORMAT 1.0\r" + kVertices + kFaces + "end_header\r\n");
  checkHeader(files, "\xef\xbb\xbf" + header);
}

TEST_CASE("PLY: every type for coordinates, counts and indices") {
  const Files files;
  for (const std::string& format : kPlyFormats) {
    for (const std::string& type : kPlyTypes) {
      INFO(format << " " << type);
      const std::string coordinates =
          "element vertex 4\nproperty " + type + " x\nproperty " + type + " y\nproperty " + type + " z\n";
      PlyData vertices(format), counts(format), indices(format);
      putVertices(vertices, type);
      putFaces(vertices);
      checkMesh(files, vertices.file(kBegin + coordinates + kFaces + "end_header\n"));
      putVertices(counts);
      putFaces(counts, type);
      checkMesh(files, counts.file(kBegin + kVertices + "element face 2\nproperty list " + type +
                                   " int vertex_index\nend_header\n"));
      putVertices(indices);
      putFaces(indices, "uchar", type);
      checkMesh(files, indices.file(kBegin + kVertices + "element face 2\nproperty list uchar " + type +
                                    " vertex_indices\nend_header\n"));
    }
  }
}

TEST_CASE("PLY: elements in any order, with others and with lists before, between and after") {
  const Files files;
  for (const std::string& format : kPlyFormats) {
    INFO(format);
    PlyData data(format);
    // A scalar and lists before the vertices; faces before vertices; lists in both; an element after all.
    data.put("uchar", 7).list("short", "double", {1, 2, 3}).put("uchar", 8).list("short", "double", {});
    for (const Triangle& t : kTriangles)
      data.list("uchar", "float", {0, 0, 1, 0, 1, 1})
          .put("double", 0.5)
          .list("int", "ushort", {double(t[0]), double(t[1]), double(t[2])})
          .put("char", -1);
    for (const glm::dvec3& p : kPositions)
      data.list("uint", "char", {-1})
          .put("int", 3)
          .put("float", p.x)
          .put("float", p.y)
          .list("uchar", "int", {})
          .put("float", p.z);
    data.list("uchar", "int", {1, 2}).put("float", 9);
    const std::string header =
        kBegin +
        "element scan 2\nproperty uchar flags\nproperty list short double times\n"
        "element face 2\nproperty list uchar float texcoord\nproperty double quality\nproperty list int ushort "
        "vertex_indices\nproperty char flags\n"
        "element vertex 4\nproperty list uint char near\nproperty int u\nproperty float x\nproperty float y\n"
        "property list uchar int faces\nproperty float z\n"
        "element edge 1\nproperty list uchar int ends\nproperty float weight\nelement none 5\nend_header\n";
    checkMesh(files, data.file(header));
  }
}

TEST_CASE("PLY: colours of any type, and numbers with the names of texture coordinates") {
  const Files files;
  for (const std::string& format : kPlyFormats) {
    for (const std::string& type : kPlyTypes) {
      INFO(format << " " << type);
      PlyData data(format);
      for (const glm::dvec3& p : kPositions) {
        for (int i = 0; i < 4; ++i) data.put(type, 1 + i);
        data.put("float", p.x).put("float", p.y).put("float", p.z);
        for (int i = 0; i < 4; ++i) data.put(type, 100 + i);
      }
      putFaces(data);
      data.put("int", 3);
      std::string header = kBegin + "element vertex 4\n";
      for (const char* const name : {"u", "v", "s", "t"}) header += "property " + type + " " + name + "\n";
      header += "property float x\nproperty float y\nproperty float z\n";
      for (const char* const name : {"red", "green", "blue", "alpha"}) header += "property " + type + " " + name + "\n";
      const std::string path =
          files.write("a.ply", data.file(header + kFaces + "element after 1\nproperty int n\nend_header\n"));
      const Mesh mesh = readMesh(path, {"v", {}});
      CHECK(mesh.positions == kPositions);
      CHECK(mesh.triangles == kTriangles);
      CHECK(attributeOf(mesh) == std::vector<float>{2, 2, 2, 2});
      CHECK(attributeOf(readMesh(path, {"blue", {}})) == std::vector<float>{102, 102, 102, 102});
    }
  }
}

TEST_CASE("PLY: infinite and NaN values, large numbers and small ones, are the same in text and binary") {
  const Files files;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const std::string& format : kPlyFormats) {
    INFO(format);
    PlyData data(format);
    for (const double value : {std::nan(""), kInfinity, -kInfinity, 1e-300})
      data.put("float", value).put("double", 1e300).put("double", 0.1f).put("float", value);
    putFaces(data);
    const Mesh mesh = readMesh(
        files.write("a.ply", data.file(kBegin +
                                       "element vertex 4\nproperty float x\nproperty double y\nproperty double "
                                       "z\nproperty float quality\n" +
                                       kFaces + "end_header\n")),
        {"quality", {}});
    CHECK(std::isnan(mesh.positions[0].x));
    CHECK(mesh.positions[1].x == kInfinity);
    CHECK(mesh.positions[2].x == -kInfinity);
    CHECK(mesh.positions[3] == glm::dvec3(0, 1e300, format == "ascii" ? 0.100000001490 : double(0.1f)));
    CHECK(std::isnan(attributeOf(mesh)[0]));
    CHECK(mesh.triangles == kTriangles);
  }
  // In float32 where that is the type: text and binary files of one mesh are one mesh.
  const std::string text = "ply\nformat ascii 1.0\n" + kVertices + kFaces + "end_header\n";
  const Mesh mesh =
      readMesh(files.write("b.ply", text + "0.1 16777217 -INF\n1 0 NaN\n+1 1 infinity\n0 1 1e-400\n3 0 1 2 3 0 2 3\n"));
  CHECK(mesh.positions[0] == glm::dvec3(0.1f, 16777216, -kInfinity));
  CHECK(mesh.positions[2].z == kInfinity);
  CHECK(mesh.float32);
  CHECK(readError(files, "c.ply", text + "0 0 1e39\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 3 0 2 3\n") ==
        "c.ply:10: z: '1e39' is beyond float32");
}

TEST_CASE("PLY: nothing of an element, faces of no corners, no faces at all") {
  const Files files;
  for (const std::string& format : kPlyFormats) {
    INFO(format);
    PlyData points(format), empty(format), odd(format);
    putVertices(points);
    CHECK(readMesh(files.write("a.ply", points.file(kBegin + kVertices + "end_header\n"))).positions == kPositions);
    CHECK(readMesh(files.write("a.ply", points.file(kBegin + kVertices + "element face 0\nend_header\n")))
              .triangles.empty());
    CHECK(readMesh(files.write("a.ply", empty.file(kBegin + "element vertex 0\nproperty float x\nelement face "
                                                            "0\nproperty list uchar int vertex_index\nend_header")))
              .positions.empty());
    putVertices(odd);
    odd.list("uchar", "int", {})
        .list("uchar", "int", {0, 1, 2})
        .list("uchar", "int", {1, 2})
        .list("uchar", "int", {0, 2, 3});
    odd.list("uchar", "int", {3});
    const Mesh mesh = readMesh(files.write(
        "b.ply",
        odd.file(kBegin + kVertices + "element face 5\nproperty list uchar int vertex_indices\nend_header\n")));
    CHECK(mesh.triangles == kTriangles);
    REQUIRE(mesh.notes.size() == 1);
    CHECK(mesh.notes[0].starts_with("3 faces have fewer than three corners"));
  }
}

TEST_CASE("PLY: triangle strips face one way, with -1 between them") {
  const Files files;
  for (const std::string& format : kPlyFormats) {
    for (const std::string type : {"int", "char", "uint"}) {
      INFO(format << " " << type);
      const double end = type == "uint" ? 4294967295.0 : -1;
      PlyData data(format);
      putVertices(data);
      data.list("int", type, {0, 1, 3, 2, end, 2, 3, 0, end});
      const Mesh mesh =
          readMesh(files.write("a.ply", data.file(kBegin + kVertices + "element tristrips 1\nproperty list int " +
                                                  type + " vertex_indices\nend_header\n")));
      CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 3}, {3, 1, 2}, {2, 3, 0}});
    }
  }
}

TEST_CASE("PLY: indices that reach no vertex are kept out of range") {
  const Files files;
  for (const std::string& format : kPlyFormats) {
    INFO(format);
    PlyData data(format);
    putVertices(data);
    data.list("uchar", "int", {0, -1, 2}).list("uchar", "int", {4, 1, 2147483647});
    const Mesh mesh = readMesh(files.write("a.ply", data.file(kBegin + kVertices + kFaces + "end_header\n")));
    CHECK(mesh.triangles == std::vector<Triangle>{{0, kBadIndex, 2}, {kBadIndex, 1, kBadIndex}});
  }
}

TEST_CASE("PLY: what is broken is named with its place") {
  const Files files;
  const std::string text = "ply\nformat ascii 1.0\n" + kVertices + kFaces + "end_header\n";
  const std::string points = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
  CHECK(readMesh(files.write("a.ply", text + points + "3 0 1 2\n3 0 2 3\n")).triangles == kTriangles);
  CHECK(readError(files, "a.ply", text + points + "3 0 1 2\n3 0 2\n") ==
        "a.ply:15: the file ends early, in vertex_indices of face 1");
  CHECK(readError(files, "a.ply", text + "comment\n" + points).starts_with("a.ply:10: x: 'comment' is not a number"));
  CHECK(readError(files, "a.ply", "ply\nformat ascii 1.0\n" + kFaces + "end_header\n3 0 1 2 3 1 2 3\n") ==
        "a.ply:5: no element 'vertex'");
  CHECK(readError(files, "a.ply", "ply\nformat ascii 1.0\nformat ascii 1.0\n") == "a.ply:3: a second format");
  std::string two = text;
  two.insert(two.find("end_header"), "property list uchar int vertex_index\n");
  CHECK(readError(files, "a.ply", two) == "a.ply:9: two lists of corners");
  // Beyond the type: a binary file could not have it.
  std::string flags = text;
  flags.insert(flags.find("element face"), "property uchar flags\n");
  CHECK(readError(files, "a.ply", flags + "0 0 0 256\n").starts_with("a.ply:11: the file ends early, in vertex"));
  CHECK(readError(files, "a.ply", flags + "0 0 0 256\n1 0 0 1\n1 1 0 1\n0 1 0 1\n3 0 1 2\n3 0 2 3\n") ==
        "a.ply:11: flags: '256' is not a whole number from 0 to 255");
  CHECK(readError(files, "a.ply", flags + "0 0 0 0.5\n1 0 0 1\n1 1 0 1\n0 1 0 1\n3 0 1 2\n3 0 2 3\n") ==
        "a.ply:11: flags: '0.5' is not a whole number");
  for (const std::string format : {"binary_little_endian", "binary_big_endian"}) {
    PlyData data(format), length(format);
    putVertices(data);
    const std::string header = kBegin + kVertices + kFaces + "end_header\n";
    CHECK(readError(files, "a.ply", data.file(header)).find("the file ends early, in face") != std::string::npos);
    length.put("char", -3);
    CHECK(readError(files, "a.ply",
                    data.file(kBegin + kVertices +
                              "element face 1\nproperty list char int "
                              "vertex_index\nend_header\n") +
                        length.bytes())
              .find("vertex_index of face 0: a list of length -3") != std::string::npos);
    std::string many = header;
    many.replace(many.find("face 2"), 6, "face 9223372036854775807");
    CHECK(readError(files, "a.ply", data.file(many)).find("the file ends early, in face") != std::string::npos);
  }
}
