#include "seeds.h"

#include <tessera/error.h>
#include <tessera/image.h>
#include <tessera/input.h>

#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>

#include "datasets/text.h"
#include "experiments/harness/cells.h"
#include "experiments/harness/journal.h"
#include "host/measure/row.h"
#include "tests/support/streams.h"
#include "tests/sweep/small-journal.h"

namespace tessera::test {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kObj{
    "# a cube's corner\nmtllib a.mtl\no one\nv 0 0 0\nv 1.5 0 0 1\nv 0 1 0 0.1 0.2 0.3\nv 1e0 +1 .5\nvt 0 1\nvn 0 0 "
    "1\nvn 1 0 0\ng a b\nusemtl red\n"
    "s off\nf 1/1/1 2/1/1 3/1/2\nf 1//2 2//2 4//1 3//1\nf -1 -2 \\\n-3\nl 1 2\np 1\nf 1 1 2\n",
    "v 0 0 0\r\nv 1 0 0\r\nv 1 1 0\r\nv 0.5 0.25 0\r\nv 0 1 0\r\nf 1 2 3 4 5\r\n"};
const std::vector<std::string> kOff{"OFF\n# comment\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1.5\n3 0 1 2\n4 0 1 2 3 255 0 0\n",
                                    "OFF4 2 0\n0 0 0 1 0 0 0 1 0 0 0 1 3 0 1 2 3 0 1 3",
                                    "COFF\n3 1 0\n0 0 0 1 0 0 1\n1 0 0 0 1 0 1\n0 1 0 0 0 1 1\n3 0 1 2\n"};
const std::string kStlText =
    "solid name\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n   vertex 0 1 0\n  endloop\n "
    "endfacet\n"
    "facet normal 0 0 0 outer loop vertex 0 0 0 vertex 1 0 0 vertex 1 0 0 endloop endfacet\nendsolid name\n";
const std::vector<std::string> kScenes{
    "size = [64, 48]\n[[mesh]]\nsource = \"generate:icosphere?level=1\"\nmatrix = [1,0,0,0.5, 0,1,0,0, 0,0,1,0, "
    "0,0,0,1]\n[[mesh]]\nsource = "
    "\"generate:torus?rings=6&sides=5&tube=0.3\"\n[camera]\neye = [0, 1, 5.0]\ntarget = [0, 0, 0]\nup = [0, 1, 0]\nfov "
    "= 45\nnear = 0.1\nfar = "
    "100\n",
    "[[mesh]]\nsource = \"generate:grid?columns=3&rows=2&angle=31\"\n",
    "[[mesh]]\nsource = \"generate:fan?count=9\"\n[camera]\nmatrix = [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]\n"};

template <class T>
void put(std::string& text, T value, bool big) {
  std::string bytes(reinterpret_cast<const char*>(&value), sizeof value);
  if (big) std::ranges::reverse(bytes);
  text += bytes;
}

/// Two triangles and a square, with a property and an element more.
std::string ply(int format) {
  const bool text = format == 0, big = format == 2;
  std::string file = "ply\nformat " +
                     std::string(text  ? "ascii"
                                 : big ? "binary_big_endian"
                                       : "binary_little_endian") +
                     " 1.0\ncomment by hand\nelement vertex 4\nproperty float x\nproperty double y\nproperty float "
                     "z\nproperty short i\n"
                     "element face 2\nproperty uchar flags\nproperty list uchar int vertex_indices\nelement edge "
                     "1\nproperty list uint short ends\nend_header\n";
  const double corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0.5}, {0, 1, 0}};
  const std::vector<std::vector<int>> faces{{0, 1, 2}, {0, 1, 2, 3}};
  if (text) return file + "0 0 0 1\n1 0 0 2\n1 1 0.5 3\n0 1 0 4\n7 3 0 1 2\n7 4 0 1 2 3\n2 0 1\n";
  for (std::int16_t i = 0; i < 4; ++i) {
    put(file, float(corners[i][0]), big);
    put(file, corners[i][1], big);
    put(file, float(corners[i][2]), big);
    put(file, i, big);
  }
  for (const auto& face : faces) {
    put(file, std::uint8_t{7}, big);
    put(file, static_cast<std::uint8_t>(face.size()), big);
    for (const std::int32_t v : face) put(file, v, big);
  }
  put(file, std::uint32_t{2}, big);
  put(file, std::int16_t{0}, big);
  put(file, std::int16_t{1}, big);
  return file;
}

std::string stl() {
  std::string file(80, ' ');
  put(file, std::uint32_t{2}, false);
  for (int facet = 0; facet < 2; ++facet) {
    for (int i = 0; i < 12; ++i) put(file, float((i * 7 + facet) % 5), false);
    put(file, std::uint16_t{0}, false);
  }
  return file;
}

std::string image(const fs::path& folder, bool more) {
  Framebuffer frame{.width = 7,
                    .height = 5,
                    .depth = std::vector<float>(35, 0.5f),
                    .ids = std::vector<std::uint32_t>(35, 3),
                    .hits = {},
                    .colour = {}};
  if (more) {
    frame.colour.assign(35, glm::vec3(0.25f));
    valuesOf(frame).assign(35, 1.5f);
  }
  writeImage(folder / "seed.exr", frame);
  return datasets::readFile(folder / "seed.exr");
}

std::string replay(const fs::path& folder) {
  writeReplay(folder / "seed.replay", loadInput("generate:icosphere?level=0", 16, 16, {"y", {}}));
  return datasets::readFile(folder / "seed.replay");
}

/// What a scene has to be, whatever it was read from.
void checkScene(const Scene& scene) {
  REQUIRE((scene.positions.empty() || scene.clip.empty()));
  REQUIRE((normalsOf(scene).empty() || normalsOf(scene).size() == scene.positions.size()));
  REQUIRE((attributeOf(scene).empty() || attributeOf(scene).size() == scene.vertexCount()));
  REQUIRE((scene.width >= 1 && scene.width <= kMaxExtent && scene.height >= 1 && scene.height <= kMaxExtent));
  for (const glm::vec3& n : normalsOf(scene)) REQUIRE(std::abs(glm::dot(n, n) - 1) < 1e-3f);
  for (const float m : scene.clipFromObject) REQUIRE(std::isfinite(m));
  for (const std::string& note : scene.notes) REQUIRE(note.find_first_of("\r\n") == std::string::npos);
  REQUIRE(sceneHash(scene).size() == 64);
}

void readScene(const fs::path& path) {
  checkScene(loadInput(path.string()));
  checkScene(loadInput(path.string(), 7, 5, {"y", {}}));
}

void readValues(const fs::path& path) { checkScene(loadInput(path.string(), 0, 0, {"i", ValueRange{0, 2}})); }

}  // namespace

std::vector<Target> targets(const fs::path& folder) {
  const std::vector<std::string> plys{ply(0), ply(1), ply(2)};
  return {{"obj", ".obj", kObj, readScene},
          {"off", ".off", kOff, readScene},
          {"ply", ".ply", plys, readScene},
          {"ply-values", ".ply", plys, readValues},
          {"stl", ".stl", {kStlText, stl()}, readScene},
          {"scene", ".toml", kScenes, readScene},
          {"replay", ".replay", {replay(folder)}, readScene},
          {"image", ".exr", {image(folder, false), image(folder, true)}, [](const fs::path& path) { readImage(path); }},
          {"sweep",
           ".toml",
           {datasets::readFile(TESSERA_SOURCE_DIR "/experiments/tile-size/sweep.toml"),
            datasets::readFile(TESSERA_SOURCE_DIR "/experiments/bin-capacity/sweep.toml"),
            datasets::readFile(TESSERA_SOURCE_DIR "/experiments/culling/sweep.toml")},
           [](const fs::path& path) {
             for (const bool quick : {false, true}) harness::cells(harness::readSweep(path, quick));
           }},
          {"journal", ".jsonl", {test::smallJournal()}, [](const fs::path& path) {
             harness::readJournal(path.parent_path());
           }}};
}

}  // namespace tessera::test
