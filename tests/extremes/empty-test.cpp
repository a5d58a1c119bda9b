// Scenes of nothing.
#include <tessera/input.h>

#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/support/compare.h"
#include "tests/support/machines.h"
#include "tests/support/variants.h"

using namespace tessera;
using namespace tessera::test;

namespace {

/// Each binning, planned and full, and each commit: what clears and what bins, with few kernels.
std::vector<Variant> paths(const Machine& machine) {
  std::vector<Variant> all = combinations({"plan", "binning"}, machine.info());
  for (const Variant& commit : combinations({"commit"}, machine.info())) all.push_back(commit);
  return all;
}

void checkEmpty(Machine& machine, const Scene& scene) {
  for (Variant variant : paths(machine)) {
    variant.set("shade", "id");
    INFO(variant.text());
    const Frame frame = machine.render(scene, variant);
    CHECK(frame.image.ids.size() == frame.image.pixels());
    CHECK(std::ranges::all_of(frame.image.ids, [](std::uint32_t id) { return id == kNoTriangle; }));
    CHECK(std::ranges::all_of(frame.image.depth, [](float z) { return z == 1.0f; }));
    CHECK(std::ranges::all_of(frame.image.colour, [](const glm::vec3& c) { return c == glm::vec3(1, 1, 1); }));
    CHECK(difference(frame, oracle::render(scene)) == "");
  }
  const Frame hits = machine.render(scene, {{"commit", "count"}});
  CHECK(hits.image.hits == std::vector<std::uint32_t>(hits.image.pixels(), 0));
}

}  // namespace

CHECKED_PLACE_TEST_CASE("An empty scene leaves an empty frame", "[extremes]") {
  Scene scene;
  scene.width = 70;
  scene.height = 33;
  SECTION("nothing at all") { checkEmpty(machine, scene); }
  SECTION("vertices without triangles") {
    scene.clip.assign(100, glm::vec4(0, 0, 0, 1));
    checkEmpty(machine, scene);
  }
  SECTION("positions without triangles") {
    scene.positions.assign(100, glm::vec3(0, 0, 0));
    checkEmpty(machine, scene);
  }
  SECTION("triangles without vertices") {
    scene.triangles.assign(100, {0, 1, 2});
    checkEmpty(machine, scene);
    CHECK(machine.render(scene).counters.at("badIndex") == 100);
  }
}

CHECKED_PLACE_TEST_CASE("A frame does not see the one before", "[extremes]") {
  const Scene full = loadInput("generate:icosphere?level=4", 200, 150);
  Scene empty;
  empty.width = 200;
  empty.height = 150;
  for (const Variant& variant : paths(machine)) {
    INFO(variant.text());
    const Frame first = machine.render(full, variant);
    CHECK(difference(machine.render(empty, variant), oracle::render(empty)) == "");
    const Frame again = machine.render(full, variant);
    CHECK(difference(again.image, first.image) == "");
    CHECK(again.counters == first.counters);
  }
}
