// What every text format here has in common: byte order marks, line ends, encodings, long and strange words.
#include "datasets/text.h"

#include <fmt/format.h>

#include <cmath>

#include "fixture.h"

using namespace tessera;
using namespace tessera::test;

namespace {

struct Format {
  const char* name;
  std::string text;
};
const std::vector<Format> kFormats{
    {"a.obj", "# one triangle\nv 0 0 0\nv 1 0 0\nv 0 1 0\n\ng a\\\n  b\nf 1 2 \\\n3\n"},
    {"a.off", "OFF\n# one triangle\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n\n3 0 1 2\n"},
    {"a.stl",
     "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
     "0\nendloop\nendfacet\nendsolid\n"},
    {"a.ply",
     "ply\nformat ascii 1.0\ncomment one triangle\nelement vertex 3\nproperty float x\nproperty float y\nproperty "
     "float z\n"
     "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"},
    {"a.toml", "# one triangle\n[[mesh]]\nsource = \"mesh.off\"\n[camera]\neye = [0, 0, 5]\ntarget = [0, 0, 0]\n"},
    {"a.replay",
     "tessera-replay 1\nname a b\nsize 8 8\nvertices 3\n00000000 00000000 00000000 3f800000\n3f800000 00000000 "
     "00000000 "
     "3f800000\n00000000 3f800000 00000000 3f800000\ntriangles 1\n0 1 2\nend\n"},
};

std::string withEnds(const std::string& text, const std::vector<std::string>& ends) {
  std::string result;
  std::size_t line = 0;
  for (const char c : text) c == '\n' ? result += ends[line++ % ends.size()] : result += c;
  return result;
}

std::string wide(const std::string& text, bool big, std::size_t width) {
  std::string result;
  for (const char c : (big ? "\xfe\xff" : "\xff\xfe") + std::string()) result += c;
  if (width == 4) result = big ? std::string("\0\0\xfe\xff", 4) : std::string("\xff\xfe\0\0", 4);
  for (const char c : text) {
    std::string unit(width, '\0');
    unit[big ? width - 1 : 0] = c;
    result += unit;
  }
  return result;
}

}  // namespace

TEST_CASE("A byte order mark and the three line ends, mixed too, change nothing in any text format") {
  const Files files;
  files.write("mesh.off", kFormats[1].text);
  for (const auto& [name, text] : kFormats) {
    const Scene expected = loadInput(files.write(name, text));
    REQUIRE(expected.triangles.size() == 1);
    for (const std::vector<std::string>& ends :
         std::vector<std::vector<std::string>>{{"\n"}, {"\r\n"}, {"\r"}, {"\n", "\r\n", "\r"}, {"\r", "\r\n", "\n"}}) {
      for (const std::string mark : {"", "\xef\xbb\xbf"}) {
        INFO(name << ", " << ends.size() << " kinds of end, mark of " << mark.size());
        std::string other = mark + withEnds(text, ends);
        const Scene scene = loadInput(files.write(name, other));
        CHECK(sceneHash(scene) == sceneHash(expected));
        CHECK(scene.triangles == expected.triangles);
        // Nor does the end of the last line.
        while (other.back() == '\n' || other.back() == '\r') other.pop_back();
        CHECK(sceneHash(loadInput(files.write(name, other))) == sceneHash(expected));
      }
    }
  }
}

TEST_CASE("UTF-16 and UTF-32 are refused by name in any text format") {
  const Files files;
  for (const auto& [name, text] : kFormats)
    for (const bool big : {false, true})
      for (const std::size_t width : {2u, 4u}) {
        const std::string path = files.write(name, wide(text, big, width));
        const std::string refusal = path + ": is UTF-16 or UTF-32; UTF-8 would be right";
        CHECK(usageError([&] { loadInput(path); }) == refusal);
        files.write(name, wide(text, big, width).substr(width));  // without its mark
        CHECK(usageError([&] { loadInput(path); }) == refusal);
      }
}

TEST_CASE("A number beyond double is one beyond float32 in any text format") {
  const Files files;
  for (const std::string number : {"1e39", "1e400", "-1e400", "1e99999"}) {
    const auto refusal = [&](std::string_view what) {
      return fmt::format("{}: '{}' is not a finite number of float32", what, number);
    };
    CHECK(readError(files, "a.obj", "v 0 0 " + number + "\n") == "a.obj:1: " + refusal("vertex (v x y z)"));
    CHECK(readError(files, "a.off", "OFF\n3 1 0\n0 0 " + number + "\n") == "a.off:3: " + refusal("vertex (x y z)"));
    std::string stl = kFormats[2].text;
    stl.replace(stl.find("1 0 0"), 1, number);
    CHECK(readError(files, "a.stl", stl).ends_with(refusal("vertex x")));
    std::string ply = kFormats[3].text;
    ply.replace(ply.find("1 0 0"), 1, number);
    CHECK(readError(files, "a.ply", ply) == fmt::format("a.ply:12: x: '{}' is beyond float32", number));
  }
  std::string doubles = kFormats[3].text;
  doubles.replace(doubles.find("float x"), 5, "double");
  doubles.replace(doubles.find("1 0 0"), 1, "-1e400");
  CHECK(readError(files, "a.ply", doubles) == "a.ply:12: x: '-1e400' is beyond float64");
  CHECK(readError(files, "a.obj", "v 0 0 inf\n").ends_with("'inf' is not a finite number"));
  CHECK(readError(files, "a.obj", "v 0 0 1e400x\n").ends_with("'1e400x' is not a number"));
}

TEST_CASE("The line of a mistake is counted by the three line ends") {
  const Files files;
  for (const std::vector<std::string>& ends :
       std::vector<std::vector<std::string>>{{"\n"}, {"\r\n"}, {"\r"}, {"\n", "\r"}}) {
    CHECK(readError(files, "a.obj", withEnds("v 0 0 0\n#\n# x\nv 1 x 0\n", ends)).starts_with("a.obj:4: "));
    CHECK(readError(files, "a.off", withEnds("OFF\n3 1 0\n0 0 0\n#\n #\n1 x 0\n", ends)).starts_with("a.off:6: "));
    const std::string toml = files.write("a.toml", withEnds("size = [8, 8]\n#\nsizes = 1\n", ends));
    CHECK(usageError([&] { loadInput(toml); }).starts_with(toml + ":3:"));
  }
}

TEST_CASE("What is strange in a file is short and harmless in a message") {
  const Files files;
  CHECK(readError(files, "a.obj", "v 1 2 \x1b[31mred\n") == "a.obj:1: vertex (v x y z): '?[31mred' is not a number");
  CHECK(readError(files, "a.obj", std::string(100000, 'x')).size() < 200);
  CHECK(readError(files, "a.obj", std::string("v 1 2 3\nf 1 2 3\0\n", 17)).starts_with("a.obj:2: corner '3?'"));
}

TEST_CASE("Progress goes from the beginning of a file to its end") {
  const Files files;
  std::string text;
  for (int i = 0; i < 200000; ++i) text += "v 0.125 0.25 0.5\n";
  std::size_t calls = 0, last = 0;
  const auto progress = [&](std::size_t done, std::size_t total) {
    CHECK(total == text.size());
    CHECK((done >= last && done <= total));
    last = done;
    ++calls;
  };
  readMesh(files.write("a.obj", text), {}, progress);
  CHECK(calls >= 3);
  CHECK(last > text.size() / 2);
}

TEST_CASE("Numbers are the nearest doubles and floats, or no numbers") {
  CHECK(datasets::toNumber("0.1") == 0.1);
  CHECK(datasets::toNumber("-1.5E+3") == -1500);
  CHECK(datasets::toNumber("+7") == 7);
  CHECK(datasets::toNumber("1e-400") == 0);
  CHECK(datasets::toNumber("1e400") == HUGE_VAL);
  CHECK(datasets::toNumber("-1e400") == -HUGE_VAL);
  CHECK(!datasets::toDouble("1e400"));
  CHECK(!datasets::toReal("1e400"));
  CHECK(!datasets::toDouble("inf"));
  for (const char* const word : {"", "+", "-", ".", "e5", "1e", "1e+", "0x10", "1,5", "1.5.2", "+-1", "--1", "1f", "١"})
    CHECK(!datasets::toNumber(word));
  // Halfway between two floats but for the last digit: rounding by way of a double would go to the even one.
  CHECK(datasets::toReal("1.00000005960464477540") == std::nextafter(1.0f, 2.0f));
  CHECK(datasets::toReal("1.00000005960464477539") == 1.0f);
  CHECK(datasets::toReal("1e-45") == 1e-45f);
  CHECK(!datasets::toReal("3.5e38"));
}
