#include <bit>
#include <fstream>
#include <iterator>

#include "fixture.h"
#include "tests/support/streams.h"

using namespace tessera;
using namespace tessera::test;

namespace {

std::string readAll(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

using Bits = std::array<std::uint32_t, 4>;

Scene strangeScene() {
  Scene scene;
  scene.name = "a name with spaces";
  scene.width = 1009;
  scene.height = 1;
  for (const Bits& bits :
       {Bits{0x7fc00001, 0xffc12345, 0x7f800001, 0x80000000}, Bits{0x7f800000, 0xff800000, 1, 0x3f800000}})
    scene.clip.push_back(std::bit_cast<glm::vec4>(bits));
  scene.triangles = {{0, 1, 0}, {0, 4294967295u, 7}};
  return scene;
}

}  // namespace

TEST_CASE("A replay file gives back every bit") {
  const Files files;
  const Scene scene = strangeScene();
  writeReplay(files.path("a.replay"), scene);
  const Scene back = loadInput(files.path("a.replay"));
  CHECK(back.name == scene.name);
  CHECK(back.width == 1009);
  CHECK(back.height == 1);
  CHECK(back.triangles == scene.triangles);
  CHECK(back.positions.empty());
  REQUIRE(back.clip.size() == scene.clip.size());
  for (std::size_t i = 0; i < scene.clip.size(); ++i)
    CHECK(std::bit_cast<Bits>(back.clip[i]) == std::bit_cast<Bits>(scene.clip[i]));
  CHECK(sceneHash(back) == sceneHash(scene));
  // Only its own file is left, and another size may be asked for.
  const std::filesystem::path folder = std::filesystem::path(files.path("x")).parent_path();
  CHECK(std::distance(std::filesystem::directory_iterator(folder), {}) == 1);
  CHECK(loadInput(files.path("a.replay"), 0, 5).height == 5);
}

TEST_CASE("A replay file of a scene in object space holds the contract's clip positions") {
  const Files files;
  Scene scene;
  scene.positions = {{0.1f, 0.2f, 0.3f}, {-0.0f, 7, 1e30f}};
  scene.triangles = {{0, 1, 1}};
  for (std::size_t i = 0; i < 16; ++i) scene.clipFromObject[i] = 0.7f * float(i) - 3.3f;
  writeReplay(files.path("a.replay"), scene);
  const Scene back = readReplay(files.path("a.replay"));
  REQUIRE(back.clip.size() == 2);
  const Matrix& m = scene.clipFromObject;
  for (std::size_t v = 0; v < 2; ++v) {
    const glm::vec3& p = scene.positions[v];
    for (int r = 0; r < 4; ++r) {
      const std::size_t i = 4 * static_cast<std::size_t>(r);
      CHECK(back.clip[v][r] == ((m[i] * p.x + m[i + 1] * p.y) + m[i + 2] * p.z) + m[i + 3]);
    }
  }
}

TEST_CASE("An empty scene has a replay file too") {
  const Files files;
  writeReplay(files.path("a.replay"), Scene{});
  const Scene back = readReplay(files.path("a.replay"));
  CHECK(back.name.empty());
  CHECK(back.vertexCount() == 0);
  CHECK(back.triangles.empty());
}

TEST_CASE("A replay file that ends early, wherever, is refused") {
  const Files files;
  writeReplay(files.path("a.replay"), strangeScene());
  const std::string whole = readAll(files.path("a.replay"));
  REQUIRE(whole.ends_with("end\n"));
  for (std::size_t length = 0; length + 1 < whole.size(); ++length) {
    const std::string path = files.write("b.replay", std::string_view(whole).substr(0, length));
    CHECK_THROWS_AS(readReplay(path), Error);
  }
}

TEST_CASE("A broken replay file is refused where it is broken") {
  const Files files;
  writeReplay(files.path("a.replay"), strangeScene());
  const std::string whole = readAll(files.path("a.replay"));
  const auto broken = [&](const std::string& from, const std::string& to) {
    std::string text = whole;
    text.replace(text.find(from), from.size(), to);
    const std::string path = files.write("b.replay", text), line = usageError([&] { loadInput(path); });
    REQUIRE(line.starts_with(path));
    return line.substr(path.size());
  };
  CHECK(broken("replay 1", "replay 2") == ":1: version '2'; 1 would be right");
  CHECK(broken("tessera-replay", "tessera") == ":1: 'tessera-replay' would be right");
  CHECK(broken("size 1009", "size 0").starts_with(":3: width: '0'"));
  CHECK(broken("size 1009", "size 32769").starts_with(":3: width: '32769'"));
  CHECK(broken("vertices 2", "vertices 99999999999").starts_with(":4: count of vertices"));
  CHECK(broken("ffc12345", "ffc1234").starts_with(":5: 'ffc1234' is not the bits"));
  CHECK(broken("ffc12345", "ffc1234g").starts_with(":5: 'ffc1234g' is not the bits"));
  CHECK(broken("4294967295", "4294967296").starts_with(":9: vertex index: '4294967296'"));
  CHECK(broken("\nend", "\n0 0 0\nend").starts_with(":10: 'end'"));
}

TEST_CASE("A replay file that cannot be written is one line") {
  const Files files;
  const std::string path = files.write("file", "not a folder") + "/a.replay";
  try {
    writeReplay(path, strangeScene());
    FAIL("no error was thrown");
  } catch (const Error& error) {
    CHECK(error.code() == ExitCode::kUsage);  // as a wrong name is
    CHECK(std::string(error.what()) == path + ": Not a directory");
  }
}

TEST_CASE("The hash of a scene changes with everything that defines its image, and with nothing else") {
  const Scene scene = loadInput("generate:torus?rings=8&sides=6");
  const std::string hash = sceneHash(scene);
  CHECK(hash.size() == 64);
  const auto hashWith = [&](auto change) {
    Scene other = scene;
    change(other);
    return sceneHash(other);
  };
  CHECK(hashWith([](Scene& s) { s.name = "other"; }) == hash);
  CHECK(hashWith([](Scene& s) { dropNormals(s); }) != hash);
  CHECK(hashWith([](Scene& s) {
          for (int i = 6; i < 9; ++i) s.makeStream(kNormals, 3, false).values[i] *= -1;
        }) != hash);
  CHECK(hashWith([](Scene& s) { s.origin.y = 64; }) != hash);
  CHECK(hashWith([](Scene& s) { attributeOf(s).resize(s.positions.size()); }) != hash);
  CHECK(hashWith([](Scene& s) { s.width ^= 1; }) != hash);
  CHECK(hashWith([](Scene& s) { std::swap(s.width, s.height = 7); }) != hash);
  CHECK(hashWith([](Scene& s) { s.clipFromObject[5] = -s.clipFromObject[5]; }) != hash);
  CHECK(hashWith([](Scene& s) { s.positions[3].y += 1; }) != hash);
  CHECK(hashWith([](Scene& s) { std::swap(s.triangles[0][1], s.triangles[0][2]); }) != hash);
  CHECK(hashWith([](Scene& s) { s.triangles.own().pop_back(); }) != hash);
  Scene zero, minus;
  zero.clip = {glm::vec4(0.0f)};
  minus.clip = {glm::vec4(-0.0f, 0, 0, 0)};
  CHECK(sceneHash(zero) != sceneHash(minus));
}
