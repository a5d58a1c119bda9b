#include <cmath>
#include <glm/geometric.hpp>

#include "fixture.h"
#include "tests/support/streams.h"

using namespace tessera;
using namespace tessera::test;

namespace {

const std::string kSphere = "[[mesh]]\nsource = \"generate:icosphere?level=0\"\n";

/// The message for a scene file, without its path.
std::string sceneError(const std::string& text) {
  const Files files;
  const std::string path = files.write("a.toml", text), line = usageError([&] { loadInput(path); });
  REQUIRE(line.starts_with(path));
  return line.substr(path.size());
}

glm::dvec4 transform(const Matrix& m, const glm::vec3& p) {
  const auto row = [&](std::size_t r) {
    return double(m[r]) * p.x + double(m[r + 1]) * p.y + double(m[r + 2]) * p.z + m[r + 3];
  };
  return {row(0), row(4), row(8), row(12)};
}

void checkInView(const Scene& scene) {
  double widest = 0;
  for (const glm::vec3& p : scene.positions) {
    const glm::dvec4 c = transform(scene.clipFromObject, p);
    REQUIRE(c.w > 0);
    CHECK(std::abs(c.x) <= c.w);
    CHECK(std::abs(c.y) <= c.w);
    CHECK(c.z >= 0);
    CHECK(c.z <= c.w);
    widest = std::fmax(widest, std::fmax(std::abs(c.x), std::abs(c.y)) / c.w);
  }
  CHECK(widest > 0.5);
}

}  // namespace

TEST_CASE("A scene: size, meshes in order with their matrices, camera matrix, paths beside the file") {
  const Files files;
  files.write("one.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  const std::string path = files.write("a.toml", R"(
size = [640, 480]
[[mesh]]
source = "one.off"
[[mesh]]
source = "one.off"
matrix = [0,-2,0,10,  1,0,0,20,  0,0,1,30,  0,0,0,1]
[[mesh]]
source = "generate:icosphere?level=0"
[camera]
matrix = [1,2,3,4, 5,6,7,8, 9,10,11,12, 13,14,15,16.5]
)");
  const Scene scene = loadInput(path);
  CHECK(scene.name == "a");
  CHECK(scene.width == 640);
  CHECK(scene.height == 480);
  CHECK(scene.triangles.size() == 22);
  CHECK(scene.triangles[1] == Triangle{3, 4, 5});
  CHECK(scene.positions[3] == glm::vec3(10, 20, 30));
  CHECK(scene.positions[4] == glm::vec3(10, 21, 30));
  CHECK(scene.positions[5] == glm::vec3(8, 20, 30));
  CHECK(normalsOf(scene)[3] == glm::vec3(0, 0, 1));
  CHECK(scene.clipFromObject[1] == 2);
  CHECK(scene.clipFromObject[15] == 16.5f);
  CHECK(loadInput(path, 100, 0).width == 100);
  CHECK(loadInput(path, 100, 0).height == 480);
}

TEST_CASE("Normals of a mesh turn with its matrix, under unequal scales and reflections too") {
  const Files files;
  files.write("one.off", "OFF\n3 1 0\n0 0 0\n1 0 1\n0 1 0\n3 0 1 2\n");  // in the plane x = z, normal (-1, 0, 1)
  const Scene scene = loadInput(
      files.write("a.toml", "[[mesh]]\nsource = \"one.off\"\nmatrix = [-3,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]\n"));
  CHECK(glm::distance(normalsOf(scene)[0], glm::normalize(glm::vec3(1.0f / 3, 0, 1))) < 1e-6f);
}

TEST_CASE("A camera by eye and target: y down, near at 0, far at 1, the aspect of the image") {
  const Files files;
  const std::string path = files.write("a.toml", "size = [200, 100]\n" + kSphere + R"([camera]
eye = [0, 0, 5]
target = [0, 0, 0]
fov = 90
near = 1
far = 9
)");
  const Matrix m = loadInput(path).clipFromObject;
  const auto near = transform(m, {0, 0, 4}), far = transform(m, {0, 0, -4}), above = transform(m, {0, 1, 0}),
             right = transform(m, {1, 0, 0});
  CHECK(near.w == Approx(1));
  CHECK(near.z == Approx(0).margin(1e-6));
  CHECK(far.z / far.w == Approx(1));
  CHECK(above.y / above.w == Approx(-0.2));
  CHECK(right.x / right.w == Approx(0.1));
  CHECK(transform(loadInput(path, 100, 100).clipFromObject, {1, 0, 0}).x / 5 == Approx(0.2));
}

TEST_CASE("Without a camera everything is in view, whatever the image's shape") {
  for (const auto& [width, height] : {std::pair{1024u, 1024u}, {1u, 4096u}, {1009u, 761u}, {4096u, 16u}}) {
    const Scene scene = loadInput("generate:torus?rings=32&sides=16", width, height);
    CHECK(scene.width == width);
    CHECK(scene.height == height);
    double widest = 0;
    for (const glm::vec3& p : scene.positions) {
      const glm::dvec4 c = transform(scene.clipFromObject, p);
      REQUIRE(c.w > 0);
      REQUIRE(std::fmax(std::abs(c.x), std::abs(c.y)) <= c.w);
      REQUIRE(c.z >= 0);
      REQUIRE(c.z <= c.w);
      widest = std::fmax(widest, std::fmax(std::abs(c.x), std::abs(c.y)) / c.w);
    }
    CHECK(widest > 0.5);
  }
  const Files files;
  checkInView(
      loadInput(files.write("a.toml", kSphere + kSphere + "matrix = [1,0,0,1e4, 0,1,0,0, 0,0,1,0, 0,0,0,1]\n")));
}

TEST_CASE("Flat generators alone fill the clip volume as they are") {
  const Files files;
  CHECK(loadInput("generate:layers?count=2").clipFromObject == kIdentity);
  CHECK(loadInput(files.write("a.toml", "[[mesh]]\nsource = \"generate:fan?count=9\"\n")).clipFromObject == kIdentity);
}

TEST_CASE("The scene files of datasets load") {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(TESSERA_SOURCE_DIR "/datasets/scenes")) {
    INFO(entry.path());
    CHECK(!loadInput(entry.path().string()).triangles.empty());
    ++count;
  }
  CHECK(count >= 3);
}

TEST_CASE("A broken scene file is refused where it is broken") {
  const std::string eye = kSphere + "[camera]\neye = [0,0,5]\n";
  CHECK(sceneError("") == ": is empty");
  CHECK(sceneError("size = [1,2\n").starts_with(":1:13: "));
  CHECK(sceneError("size = [8, 8]\n").find("at least one [[mesh]]") != std::string::npos);
  CHECK(sceneError("width = 8\n" + kSphere)
            .starts_with(":1:1: a scene has no key 'width'; there are size, mesh, camera"));
  CHECK(sceneError(kSphere + "  colour = 3\n").starts_with(":3:3: [[mesh]] has no key 'colour'"));
  CHECK(sceneError(eye + "zoom = 3\n").starts_with(":5:1: [camera] has no key 'zoom'"));
  CHECK(sceneError("size = [0, 8]\n" + kSphere).starts_with(":1:8: size: 0 is not"));
  CHECK(sceneError("size = [8, 32769]\n" + kSphere).starts_with(":1:8: size: 32769 is not"));
  CHECK(sceneError("size = [8.5, 8]\n" + kSphere).starts_with(":1:8: size: 8.5 is not"));
  CHECK(sceneError("size = [8]\n" + kSphere).starts_with(":1:8: size: 2 finite numbers"));
  CHECK(sceneError("mesh = 3\n").starts_with(":1:8: mesh: [[mesh]] would be right"));
  CHECK(sceneError("[[mesh]]\nmatrix = []\n").starts_with(":1:1: source is missing"));
  CHECK(sceneError("[[mesh]]\nsource = 3\n").starts_with(":2:10: source: a string"));
  CHECK(sceneError("[[mesh]]\nsource = \"none.off\"\n").find("none.off: no such file") != std::string::npos);
  CHECK(sceneError("[[mesh]]\nsource = \"generate:foo\"\n").starts_with(":2:10: generate:foo: no such generator"));
  CHECK(sceneError("[[mesh]]\nsource = \"b.toml\"\n").find("unknown extension '.toml'") != std::string::npos);
  CHECK(sceneError(kSphere + "matrix = [1,2,3]\n").starts_with(":3:10: matrix: 16 finite numbers"));
  CHECK(
      sceneError(kSphere + "matrix = [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,1,1]\n").starts_with(":3:10: matrix: a last row"));
  CHECK(sceneError(kSphere + "matrix = [1,0,0,0, 0,1,0,0, 0,0,1e99,0, 0,0,0,1]\n")
            .starts_with(":3:10: matrix: 1e+99 is beyond"));
  CHECK(sceneError(kSphere + "matrix = [1,0,0,0, 0,nan,0,0, 0,0,1,0, 0,0,0,1]\n")
            .starts_with(":3:10: matrix: 16 finite"));
  CHECK(sceneError(kSphere + "camera = 3\n").starts_with(":3:1: [[mesh]] has no key 'camera'"));
  CHECK(sceneError("camera = 3\n" + kSphere).starts_with(":1:10: camera: [camera] would be right"));
  CHECK(sceneError(eye).find("target is missing") != std::string::npos);
  CHECK(sceneError(eye + "target = [0,0,5]\n").find("eye and target are one point") != std::string::npos);
  CHECK(sceneError(eye + "target = [0,0,0]\nup = [0,0,1]\n").find("up lies along") != std::string::npos);
  CHECK(sceneError(eye + "target = [0,0,0]\nfov = 180\n").find("fov 180: between") != std::string::npos);
  CHECK(sceneError(eye + "target = [0,0,0]\nnear = 0\n").find("near 0 and far") != std::string::npos);
  CHECK(sceneError(eye + "target = [0,0,0]\nfar = 0.01\n").find("near 0.1 and far 0.01") != std::string::npos);
  CHECK(sceneError(eye + "target = [0,0]\n").find("target: 3 finite numbers") != std::string::npos);
  CHECK(sceneError(eye + "matrix = [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]\n").find("matrix and other keys") !=
        std::string::npos);
}
