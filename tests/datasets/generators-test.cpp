#include "datasets/generators.h"

#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <map>

#include "datasets/random.h"
#include "fixture.h"
#include "tests/support/streams.h"

using namespace tessera;
using namespace tessera::test;

namespace {

double area(const Mesh& mesh, const Triangle& t) {
  const glm::dvec3 a(mesh.positions[t[0]]), b(mesh.positions[t[1]]), c(mesh.positions[t[2]]);
  return glm::length(glm::cross(b - a, c - a)) / 2;
}

/// How often each edge is used, in the direction a -> b.
std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> count;
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) ++count[{t[k], t[(k + 1) % 3]}];
  return count;
}

}  // namespace

TEST_CASE("Generators make what they say, the same bits on every machine") {
  struct Expected {
    const char* spec;
    std::size_t triangles;
    const char* hash;
  };
  const auto& e = GENERATE(values<Expected>({
      {"icosphere", 20480, "f83bd28298ed295f8827aaca59d22bccced09a920e13d158dc641cc3f0be170e"},
      {"icosphere?level=0", 20, "d187e133b724b656f89c0fb22dc32e35eaaa8ec0e83ad952545e99f22f3c89a7"},
      {"torus", 16384, "b32444e9f2049a5c341bdb99e14b428d3afb0abb64a06492b1d5917fb9e688b0"},
      {"grid?columns=10&rows=7&angle=33.3", 140, "131a30d6d2e55871d9007ba1082c55d6fda425a19da8a9c110d59b238fc87df0"},
      {"fan", 1000, "a7248aab1d0905bdad7eed7256b4a3097bd507785f5cf0d4522d9206100d090a"},
      {"slivers", 2000, "19eb76c1903b8ece98b1d11f7e14419e028260f13b5fdd84f96b3898c57302ee"},
      {"soup?count=5000", 5000, "6b6a9b5ba3b3f30fb24234dff4064d0f3deed16b4284fa98d91cc3b3dc431ce5"},
      {"layers", 128, "58cb002dffa292b34d90f8ee21e2ab9ef201632a3c097c279ace4ea769b85d83"},
      {"hot?count=5000", 5000, "1c944f440788184d81e03aa17c43dad27177983c85c7b7350644cd45c2a0b39b"},
  }));
  const Scene scene = loadInput(std::string("generate:") + e.spec);
  INFO(e.spec);
  CHECK(scene.triangles.size() == e.triangles);
  CHECK(sceneHash(scene) == e.hash);
  CHECK(normalsOf(scene).size() == scene.positions.size());
  for (const glm::vec3& n : normalsOf(scene)) REQUIRE(glm::length(n) == Approx(1).margin(1e-6));
  for (const Triangle& t : scene.triangles)
    for (const std::uint32_t v : t) REQUIRE(v < scene.positions.size());
}

TEST_CASE("Every generator has a golden hash, a line of help and a line in the README") {
  CHECK(datasets::generators().size() == 8);
  REQUIRE(generatorDocs().size() == datasets::generators().size());
  std::string readme;
  {
    std::FILE* const file = std::fopen(TESSERA_SOURCE_DIR "/datasets/README.md", "rb");
    REQUIRE(file);
    for (int c; (c = std::fgetc(file)) != EOF;) readme += static_cast<char>(c);
    std::fclose(file);
  }
  for (const GeneratorDoc& doc : generatorDocs()) {
    INFO(doc.name);
    CHECK(readme.find("| `" + doc.name + "` | " + doc.parameters + " | " + doc.makes + " |") != std::string::npos);
  }
}

TEST_CASE("Solids are closed and face outwards") {
  for (const char* spec : {"icosphere?level=0", "icosphere?level=3", "torus?rings=12&sides=7&tube=0.3"}) {
    INFO(spec);
    const Mesh mesh = generateMesh(spec);
    const auto count = edges(mesh);
    for (const auto& [edge, times] : count) {
      REQUIRE(times == 1);
      REQUIRE(count.contains({edge.second, edge.first}));
    }
    double volume = 0;
    for (const Triangle& t : mesh.triangles) {
      const glm::dvec3 a(mesh.positions[t[0]]), b(mesh.positions[t[1]]), c(mesh.positions[t[2]]);
      volume += glm::dot(a, glm::cross(b, c)) / 6;
    }
    CHECK(volume > 0.3);
  }
  for (const glm::dvec3& p : generateMesh("icosphere?level=5").positions)
    REQUIRE(glm::length(p) == Approx(1).margin(1e-6));
}

TEST_CASE("Flat generators lie in the clip volume and face the eye") {
  for (const datasets::Generator& generator : datasets::flatGenerators()) {
    INFO(generator.name);
    const bool many = generator.name == "hot" || generator.name == "soup";
    const Mesh mesh = generateMesh(generator.name + (many ? "?count=2000" : ""));
    double all = 0;
    for (const Triangle& t : mesh.triangles) {
      const glm::vec3 a = mesh.positions[t[0]], b = mesh.positions[t[1]], c = mesh.positions[t[2]];
      // Counter-clockwise on a screen with y down; loose triangles lie either way.
      if (!many) REQUIRE(glm::cross(b - a, c - a).z < 0);
      all += area(mesh, t);
    }
    CHECK(all > (many ? 0.1 : 0.5));
    for (const glm::vec3 p : mesh.positions) {
      REQUIRE((p.z >= 0 && p.z <= 1));
      REQUIRE(std::fmax(std::abs(p.x), std::abs(p.y)) <= (generator.name == "soup" ? 1.02f : 1.0f));
    }
  }
}

TEST_CASE("Loose triangles have the size and the place that was asked for") {
  const double pixel = 4.0 / (2048 * 2048);
  const Mesh soup = generateMesh("soup?count=50000&pixels=100&seed=3");
  double sum = 0;
  for (const Triangle& t : soup.triangles)
    sum += std::abs(
               glm::cross(soup.positions[t[1]] - soup.positions[t[0]], soup.positions[t[2]] - soup.positions[t[0]]).z) /
           2;
  CHECK(sum / 50000 / pixel == Approx(100).epsilon(0.02));
  for (const glm::dvec3& p : generateMesh("hot?count=3000&block=16").positions) {
    REQUIRE((p.x >= 0 && p.x < 32.0f / 2048));
    REQUIRE((p.y >= 0 && p.y < 32.0f / 2048));
  }
}

TEST_CASE("Layers come in the order that was asked for") {
  const auto depths = [](const std::string& order) {
    const Mesh mesh = generateMesh("layers?count=4&order=" + order);
    std::vector<float> z;
    for (std::size_t t = 0; t < mesh.triangles.size(); t += 2)
      z.push_back(static_cast<float>(mesh.positions[mesh.triangles[t][0]].z));
    return z;
  };
  CHECK(depths("far-to-near") == std::vector<float>{0.875f, 0.625f, 0.375f, 0.125f});
  CHECK(depths("near-to-far") == std::vector<float>{0.125f, 0.375f, 0.625f, 0.875f});
}

TEST_CASE("Seeds are followed") {
  const auto hash = [](const std::string& spec) { return sceneHash(loadInput("generate:" + spec)); };
  CHECK(hash("soup?count=100&seed=1") == hash("soup?seed=1&count=100"));
  CHECK(hash("soup?count=100&seed=1") == hash("soup?count=100"));
  CHECK(hash("soup?count=100&seed=1") != hash("soup?count=100&seed=2"));
  CHECK(hash("hot?count=100&seed=1") != hash("hot?count=100&seed=2"));
}

TEST_CASE("The random numbers are those of SplitMix64") {
  datasets::Random random(1234567);  // the reference implementation's first outputs for this seed
  CHECK(random.bits() == 6457827717110365317u);
  CHECK(random.bits() == 3203168211198807973u);
  CHECK(random.bits() == 9817491932198370423u);
}

TEST_CASE("Points of the circle") {
  for (int i = -40; i <= 80; ++i) {
    const double part = i / 37.0;
    const glm::dvec2 p = datasets::circlePoint(part);
    CHECK(std::abs(p.x - std::cos(6.283185307179586 * part)) < 4e-15);
    CHECK(std::abs(p.y - std::sin(6.283185307179586 * part)) < 4e-15);
  }
  CHECK(datasets::circlePoint(0.25) == glm::dvec2(0, 1));
  CHECK(datasets::circlePoint(0.5) == glm::dvec2(-1, 0));
}

TEST_CASE("Bad parameters of generators are refused") {
  const auto error = [](const std::string& spec) { return usageError([&] { loadInput("generate:" + spec); }); };
  CHECK(error("sphere") ==
        "generate:sphere: no such generator; did you mean icosphere? There are icosphere, torus, grid, fan, slivers, "
        "soup, layers, hot");
  CHECK(error("").starts_with("generate: of what? There are icosphere"));
  CHECK(error("icosphere?level=10") == "generate:icosphere: level=10 is not 0 to 9");
  CHECK(error("icosphere?level=-1") == "generate:icosphere: level=-1 is not 0 to 9");
  CHECK(error("icosphere?level=2.5") == "generate:icosphere: level=2.5 is not 0 to 9");
  CHECK(error("icosphere?level=") == "generate:icosphere: level= is not 0 to 9");
  CHECK(error("icosphere?level") == "generate:icosphere: 'level' has no value; level=VALUE of 0 to 9 would be right");
  CHECK(error("icosphere?size=3") == "generate:icosphere: no parameter 'size'; there is level");
  CHECK(error("icosphere?level=1&level=2") == "generate:icosphere: level is given twice");
  CHECK(error("torus?tube=nan") == "generate:torus: tube=nan is not real 0.01 to 1");
  CHECK(error("layers?order=up") == "generate:layers: order=up is not far-to-near or near-to-far");
  CHECK(error("soup?count=1e3").starts_with("generate:soup: count=1e3 is not 1 to 10000000"));
  CHECK(usageError([] { loadInput("generate:fan", 32769, 1); }).starts_with("size 32769x1"));
}
