// Triangles that cannot be drawn, among others that can.
#include <fmt/format.h>
#include <tessera/input.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "tests/support/compare.h"
#include "tests/support/machines.h"
#include "tests/support/random-scene.h"
#include "tests/support/streams.h"
#include "tests/support/variants.h"

using namespace tessera;
using namespace tessera::test;

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kLargest = std::numeric_limits<float>::max();

/// A sphere in clip space, 200 x 150.
Scene goodScene() {
  Scene scene = loadInput("generate:icosphere?level=3", 200, 150);
  scene.clip = oracle::transform(scene);
  scene.positions.clear();
  dropNormals(scene);
  return scene;
}

std::vector<Variant> paths(const DeviceInfo& device) {
  std::vector<Variant> all = combinations({"plan", "binning"}, device);
  all.push_back({{"binning", "queue"}, {"capacity", "16"}, {"tile", "8"}});
  return all;
}

/// Renders the good scene with `bad` added behind its last triangle: the image is the good one's, `bad.size()` drops
/// are counted as `counter`.
void checkDropped(Machine& machine, const std::vector<std::array<glm::vec4, 3>>& bad, const char* counter) {
  const Scene good = goodScene();
  Scene scene = good;
  for (const auto& corners : bad) {
    const auto first = static_cast<std::uint32_t>(scene.clip.size());
    scene.clip.own().insert(scene.clip.own().end(), corners.begin(), corners.end());
    scene.triangles.push_back({first, first + 1, first + 2});
  }
  const oracle::Result oracle = oracle::render(scene);
  CHECK(difference(oracle.image, oracle::render(good).image) == "");
  for (const Variant& variant : paths(machine.info())) {
    INFO(counter << ", " << variant.text());
    const Frame before = machine.render(good, variant), frame = machine.render(scene, variant);
    CHECK(difference(frame, oracle) == "");
    CHECK(difference(frame.image, before.image) == "");
    CHECK(frame.counters.at(counter) == before.counters.at(counter) + bad.size());
  }
}

}  // namespace

CHECKED_PLACE_TEST_CASE("Indices out of range are dropped and counted", "[extremes]") {
  const Scene good = goodScene();
  const auto vertices = static_cast<std::uint32_t>(good.clip.size());
  Scene scene = good;
  std::uint64_t bad = 0;
  for (const std::uint32_t index :
       {vertices, vertices + 1, 0x3fffffffu, 0x7fffffffu, 0x80000000u, 0xfffffffeu, 0xffffffffu})
    for (std::size_t corner = 0; corner < 3; ++corner, ++bad) {
      Triangle t{1, 2, 3};
      t[corner] = index;
      scene.triangles.push_back(t);
    }
  const oracle::Result oracle = oracle::render(scene);
  CHECK(oracle.counts.badIndex == bad);
  for (const Variant& variant : paths(machine.info())) {
    INFO(variant.text());
    const Frame frame = machine.render(scene, variant);
    CHECK(difference(frame, oracle) == "");
    CHECK(difference(frame.image, machine.render(good, variant).image) == "");
  }
}

CHECKED_PLACE_AND_SWIFTSHADER_TEST_CASE("Vertices that are not finite are dropped and counted", "[extremes]") {
  std::vector<std::array<glm::vec4, 3>> bad;
  for (const float value : {kNaN, kInfinity, -kInfinity})
    for (int corner = 0; corner < 3; ++corner)
      for (int part = 0; part < 4; ++part) {
        std::array<glm::vec4, 3> t{glm::vec4(-1, -1, 0, 1), glm::vec4(1, -1, 0, 1), glm::vec4(0, 1, 0, 1)};
        t[static_cast<std::size_t>(corner)][part] = value;
        bad.push_back(t);
      }
  checkDropped(machine, bad, "nonFinite");
}

CHECKED_PLACE_AND_SWIFTSHADER_TEST_CASE("Triangles without area are dropped and counted", "[extremes]") {
  const glm::vec4 a(-0.9f, -0.8f, 0, 1), b(0.9f, 0.8f, 0, 1), middle(0, 0, 0, 1), near(-0.9f + 1e-6f, -0.8f, 0, 1);
  checkDropped(machine,
               {{a, middle, b},
                {a, a, b},
                {a, b, a},
                {b, a, a},
                {a, a, a},
                {a, near, b},
                {a * 2.0f, a, b},
                {glm::vec4(0, 0, 0, 1), glm::vec4(0.5f, 0, 0, 1), glm::vec4(1, 0, 0, 1)}},
               "zeroArea");
  Scene scene = goodScene();
  const oracle::Result good = oracle::render(scene);
  scene.triangles.push_back({5, 5, 9});
  scene.triangles.push_back({5, 9, 5});
  scene.triangles.push_back({9, 5, 5});
  const Frame frame = machine.render(scene);
  CHECK(difference(frame.image, good.image) == "");
  CHECK(frame.counters.at("zeroArea") == good.counts.zeroArea + 3);
}

CHECKED_PLACE_TEST_CASE("Triangles that are nowhere in front of the eye are dropped and counted", "[extremes]") {
  std::vector<std::array<glm::vec4, 3>> bad;
  for (const float w : {-1.0f, -1e-30f, -kLargest / 4})
    for (const float z : {0.5f, -0.5f, 0.0f})
      bad.push_back({glm::vec4(w, -w, z, w), glm::vec4(-w, w, z, w), glm::vec4(w, w, z * 2, w)});
  bad.push_back({glm::vec4(1, 0, 1, 0), glm::vec4(0, 1, 1, 0), glm::vec4(1, 1, 1, 0)});
  checkDropped(machine, bad, "outside");
  // w of 0 and no coordinate outside of a plane: nothing is clipped away, but nothing can be projected.
  const glm::vec4 nothing(0, 0, 0, 0), minus(-0.0f, 0, -0.0f, 0);
  checkDropped(machine, {{nothing, nothing, nothing}, {nothing, minus, nothing}}, "behind");
}

CHECKED_PLACE_TEST_CASE("Pieces between samples are dropped and counted", "[extremes]") {
  const Scene good = goodScene();
  Scene scene = good;
  for (int i = 0; i < 10; ++i) {
    // Within 0.3 of a pixel's corner.
    const float x = static_cast<float>(10 * i), y = static_cast<float>(7 * i), width = 100, height = 75;
    const auto first = static_cast<std::uint32_t>(scene.clip.size());
    for (const auto& [dx, dy] : {std::pair{-0.3f, -0.3f}, {0.3f, 0.0f}, {0.0f, 0.3f}})
      scene.clip.emplace_back((x + dx - width) / width, (y + dy - height) / height, 0.0f, 1.0f);
    scene.triangles.push_back({first, first + 1, first + 2});
  }
  for (const Variant& variant : paths(machine.info())) {
    INFO(variant.text());
    const Frame frame = machine.render(scene, variant), before = machine.render(good, variant);
    CHECK(difference(frame.image, before.image) == "");
    const bool dropping = frame.plan.resolved.get("between-samples") == "on";
    CHECK(frame.counters.at("betweenSamples") == (dropping ? before.counters.at("betweenSamples") + 10 : 0));
  }
}

CHECKED_PLACE_TEST_CASE("Object space that is not finite is dropped and counted", "[extremes]") {
  Scene scene = loadInput("generate:icosphere?level=3", 200, 150);
  scene.positions[3].x = kNaN;
  scene.positions[40].y = kInfinity;
  scene.positions[90].z = -kLargest;  // the matrix takes it beyond float32
  scene.clipFromObject[10] *= 4;
  const oracle::Result oracle = oracle::render(scene);
  CHECK(oracle.counts.nonFinite > 10);
  CHECK(oracle.counts.covered > 1000);
  for (const Variant& variant : paths(machine.info())) {
    INFO(variant.text());
    CHECK(difference(machine.render(scene, variant), oracle) == "");
  }
  for (const float value : {kNaN, kInfinity}) {
    Scene none = loadInput("generate:icosphere?level=3", 200, 150);
    none.clipFromObject[15] = value;
    const Frame frame = machine.render(none);
    CHECK(frame.counters.at("nonFinite") == none.triangles.size());
    CHECK(difference(frame, oracle::render(none)) == "");
  }
}

CHECKED_PLACE_TEST_CASE("Random scenes stay within bounds", "[extremes]") {
  const std::vector<Variant> variants = paths(machine.info());
  for (std::uint64_t seed = 20000; seed < 20150; ++seed) {
    const Scene scene = randomScene(seed);
    const Variant& variant = variants[seed % variants.size()];
    INFO(scene.name << ", " << variant.text());
    CHECK(difference(machine.render(scene, variant), oracle::render(scene)) == "");
  }
}
