// Attributes by name: coordinates of anything, scalars of PLY in each format and type, ranges, scenes, replays.
#include <cmath>
#include <cstring>
#include <limits>

#include "fixture.h"
#include "tests/support/streams.h"

using namespace tessera;
using namespace tessera::test;

namespace {

struct Field {
  const char* type;
  double value;  ///< of vertex v: value + v
};
const std::vector<Field> kFields{{"char", -3},    {"int8", -3},      {"uchar", 200},    {"uint8", 200},
                                 {"short", -300}, {"int16", -300},   {"ushort", 60000}, {"uint16", 60000},
                                 {"int", -70000}, {"int32", -70000}, {"uint", 4e6},     {"uint32", 4e6},
                                 {"float", 0.5},  {"float32", 0.5},  {"double", 0.125}, {"float64", 0.125}};

std::string nameOf(std::size_t field) { return "p" + std::to_string(field); }

template <class T>
void putAs(std::string& out, double value, bool big) {
  const auto number = static_cast<T>(value);
  char bytes[sizeof number];
  std::memcpy(bytes, &number, sizeof number);
  if (big) std::reverse(bytes, bytes + sizeof number);
  out.append(bytes, sizeof number);
}

void put(std::string& out, const std::string& format, const std::string& type, double value) {
  if (format == "ascii") {
    char text[32];
    std::snprintf(text, sizeof text, "%.9g ", value);
    out += text;
    return;
  }
  const bool big = format == "binary_big_endian";
  if (type == "char" || type == "int8") putAs<std::int8_t>(out, value, big);
  if (type == "uchar" || type == "uint8") putAs<std::uint8_t>(out, value, big);
  if (type == "short" || type == "int16") putAs<std::int16_t>(out, value, big);
  if (type == "ushort" || type == "uint16") putAs<std::uint16_t>(out, value, big);
  if (type == "int" || type == "int32") putAs<std::int32_t>(out, value, big);
  if (type == "uint" || type == "uint32") putAs<std::uint32_t>(out, value, big);
  if (type == "float" || type == "float32") putAs<float>(out, value, big);
  if (type == "double" || type == "float64") putAs<double>(out, value, big);
}

/// Three vertices with a property of each type, some ahead of the coordinates; an element of two numbers comes first.
std::string everyType(const std::string& format) {
  std::string text = "ply\nformat " + format + " 1.0\nelement station 2\nproperty short a\nproperty double b\n";
  text += "element vertex 3\n";
  for (std::size_t i = 0; i < kFields.size(); ++i) {
    if (i == 5) text += "property float x\nproperty float y\nproperty float z\n";
    text += std::string("property ") + kFields[i].type + " " + nameOf(i) + "\n";
  }
  text += "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  for (int s = 0; s < 2; ++s) put(text, format, "short", 1), put(text, format, "double", 2);
  for (int v = 0; v < 3; ++v) {
    for (std::size_t i = 0; i < kFields.size(); ++i) {
      if (i == 5)
        for (const double c : {double(v == 1), double(v == 2), 7.0}) put(text, format, "float", c);
      put(text, format, kFields[i].type, kFields[i].value + v);
    }
    if (format == "ascii") text += v == 1 ? "\n\n" : "\n";  // words count, not lines
  }
  put(text, format, "uchar", 3);
  for (const int v : {0, 1, 2}) put(text, format, "int", v);
  return text;
}

/// One triangle with integers `i` and reals `r`.
std::string triangle(const std::string& i0, const std::string& i1, const std::string& i2) {
  return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty int "
         "i\n"
         "property float r\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0 " +
         i0 + " 0\n1 0 0 " + i1 + " 0.5\n0 1 0 " + i2 + " 2\n3 0 1 2\n";
}

using Values = std::vector<float>;

}  // namespace

TEST_CASE("PLY: every scalar type is an attribute in text and both byte orders") {
  const Files files;
  for (const std::string format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    const std::string path = files.write("a.ply", everyType(format));
    for (std::size_t i = 0; i < kFields.size(); ++i) {
      INFO(format << " " << kFields[i].type);
      const auto first = static_cast<float>(kFields[i].value);
      CHECK(attributeOf(readMesh(path, {nameOf(i), {}})) == Values{first, first + 1, first + 2});
    }
    CHECK(attributeOf(readMesh(path)).empty());
    CHECK(readMesh(path).positions[1] == glm::dvec3(1, 0, 7));
  }
}

TEST_CASE("An integer property is mapped to a range and no other is") {
  const Files files;
  const std::string path = files.write("a.ply", triangle("0", "32767", "8191"));
  const ValueRange range{-100, 300};
  const Values mapped = attributeOf(readMesh(path, {"i", range}));
  CHECK(mapped == Values{-100, 300, static_cast<float>(-100 + 400.0 * (8191 / 32767.0))});
  CHECK(attributeOf(readMesh(path, {"i", {}})) == Values{0, 32767, 8191});
  CHECK(attributeOf(readMesh(path, {"r", range})) == Values{0, 0.5f, 2});
  CHECK(attributeOf(loadInput(path, 0, 0, {"y", range})) == Values{0, 0, 1});
  for (const char* const beyond : {"32768", "-1"}) {
    const std::string wrong = files.write("b.ply", triangle("0", beyond, "0"));
    CHECK(usageError([&] {
            readMesh(wrong, {"i", range});
          }) == wrong + ": i of vertex 1: " + beyond + " cannot be mapped to a range; integers of 0 to 32767 can");
    CHECK(attributeOf(readMesh(wrong, {"i", {}}))[1] == std::stof(beyond));
  }
}

TEST_CASE("Coordinates are attributes of anything but a replay") {
  const Files files;
  const Scene grid = loadInput("generate:grid?columns=2&rows=3", 8, 8, {"y", {}});
  CHECK(attributeName(grid) == "y");
  REQUIRE(attributeOf(grid).size() == grid.positions.size());
  for (std::size_t v = 0; v < grid.positions.size(); ++v) CHECK(attributeOf(grid)[v] == grid.positions[v].y);
  CHECK(attributeOf(loadInput("generate:grid")).empty());
  const std::string obj = files.write("a.obj", "v 1 2 3\nv 4 5 6\nv 7 8 10\nf 1 2 3\n");
  CHECK(attributeOf(loadInput(obj, 0, 0, {"z", {}})) == Values{3, 6, 10});
}

TEST_CASE("A scene joins the attributes of its meshes and refuses one that lacks it") {
  const Files files;
  files.write("a.ply", triangle("1", "2", "3"));
  files.write("b.ply", triangle("4", "5", "6"));
  const std::string meshes =
      "[[mesh]]\nsource = \"a.ply\"\n[[mesh]]\nsource = \"b.ply\"\nmatrix = [1,0,0,10, 0,1,0,0, 0,0,1,0, 0,0,0,1]\n";
  const std::string path = files.write("a.toml", meshes);
  const Scene scene = loadInput(path, 0, 0, {"i", {}});
  CHECK(attributeOf(scene) == Values{1, 2, 3, 4, 5, 6});
  CHECK(attributeOf(loadInput(path, 0, 0, {"x", {}})) == Values{0, 1, 0, 10, 11, 10});
  const std::string more = files.write("b.toml", meshes + "[[mesh]]\nsource = \"generate:grid\"\n");
  CHECK(usageError([&] {
          loadInput(more, 0, 0, {"i", {}});
        }) == more + ":7:10: generate:grid: no attribute 'i'; there are x, y, z");
}

TEST_CASE("A name that is not there is refused and those there are named") {
  const Files files;
  const std::string ply = files.write("a.ply", triangle("1", "2", "3")), obj = files.write("a.obj", "v 0 0 0\n");
  CHECK(usageError([&] { readMesh(ply, {"q", {}}); }) == ply + ": no attribute 'q'; there are x, y, z, i, r");
  CHECK(usageError([&] { readMesh(obj, {"q", {}}); }) == obj + ": no attribute 'q'; there are x, y, z");
  CHECK(usageError([] {
          loadInput("generate:fan", 0, 0, {"q", {}});
        }) == "generate:fan: no attribute 'q'; there are x, y, z");
  const std::string bad = files.write("c.ply", triangle("1", "2.5e", "3"));
  CHECK(usageError([&] { readMesh(bad, {"i", {}}); }).starts_with(bad));
}

TEST_CASE("A replay keeps the attribute and its bits") {
  const Files files;
  Scene scene;
  scene.clip = {{0, 0, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}};
  scene.triangles = {{0, 1, 2}};
  attributeOf(scene) = {-0.0f, std::numeric_limits<float>::quiet_NaN(), 1e-40f};
  nameAttribute(scene, "height");
  const std::string path = files.path("a.replay");
  writeReplay(path, scene);
  for (const char* const name : {"", "height"}) {
    const Scene read = loadInput(path, 0, 0, {name, {}});
    CHECK(attributeName(read) == "height");
    REQUIRE(attributeOf(read).size() == 3);
    CHECK(std::memcmp(attributeOf(read).data(), attributeOf(scene).data(), 12) == 0);
  }
  CHECK(usageError([&] { loadInput(path, 0, 0, {"x", {}}); }) == path + ": no attribute 'x'; there is height");
  const std::string before = sceneHash(scene);
  attributeOf(scene)[0] = 1;
  CHECK(sceneHash(scene) != before);
  dropAttribute(scene);
  writeReplay(path, scene);
  CHECK(usageError([&] { loadInput(path, 0, 0, {"x", {}}); }) == path + ": no attribute 'x'; there are none");
}
