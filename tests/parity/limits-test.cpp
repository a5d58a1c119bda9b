// Many triangles in one place, and one triangle over many tiles.
#include <tessera/input.h>

#include <catch2/catch.hpp>

#include "tests/support/compare.h"
#include "tests/support/machines.h"
#include "tests/support/variants.h"

using namespace tessera;
using namespace tessera::test;

PLACE_TEST_CASE("Nothing of 500000 triangles in one block is lost", "[limits]") {
  // By way of GLSL a fifth: the other route to the same driver has them all.
  const bool less = machine.route() == Route::kGlsl;
  const Scene scene = loadInput(less ? "generate:hot?count=100000&block=64" : "generate:hot?count=500000&block=64", 2048, 2048);
  const oracle::Result oracle = oracle::render(scene);
  const Frame byExact = machine.render(scene, {{"binning", "exact"}, {"commit", "count"}});
  const Frame byQueue = machine.render(scene, {{"binning", "queue"}, {"commit", "count"}, {"capacity", "16"}});
  CHECK(byExact.counters.at("retries") == 0);
  CHECK(byQueue.counters.at("retries") > 0);
  for (const Frame* frame : {&byExact, &byQueue}) {
    CHECK(difference(*frame, oracle) == "");
    CHECK(frame->counters.at("overflowed") == 0);
    // One block is one tile: each triangle that is left after setup is in it.
    CHECK(frame->counters.at("largestBin") == frame->counters.at("pieces"));
    CHECK(frame->counters.at("binned") == frame->counters.at("pieces"));
  }
  CHECK(difference(machine.render(scene).image, oracle.image) == "");
}

PLACE_TEST_CASE("Thousands of triangles over whole tiles are all tested", "[limits]") {
  // More cells in one tile than a lane may loop over on a device that bounds its loops; the nearest layer comes last.
  const Scene scene = loadInput("generate:layers?count=1500&order=far-to-near", 64, 64);
  const oracle::Result oracle = oracle::render(scene);
  for (const Variant& variant : combinations({"tile", "commit"}, machine.info())) {
    INFO(variant.text());
    CHECK(difference(machine.render(scene, variant), oracle) == "");
  }
  const Variant hits{{"commit", "count"}, {"binning", "exact"}};
  CHECK(difference(machine.render(scene, hits), oracle) == "");
}

PLACE_TEST_CASE("A triangle covers the whole of 4096 x 4096 on each path", "[limits]") {
  Scene scene;
  scene.width = scene.height = 4096;
  scene.clip = {{-1.0f, -1.0f, 0.0f, 1.0f}, {-1.0f, 3.0f, 0.5f, 1.0f}, {3.0f, -1.0f, 1.0f, 1.0f}};
  scene.triangles = {{0, 1, 2}};
  const oracle::Result oracle = oracle::render(scene);
  REQUIRE(oracle.counts.covered == std::uint64_t{4096} * 4096);
  // On a software driver seconds a frame: there, what chooses cells and tiles.
  std::vector<Variant> variants = eachAlone({}, machine.info());
  if (machine.info().correctnessOnly) {
    variants = combinations({"binning"}, machine.info());
    for (const Variant& traversal : combinations({"traversal"}, machine.info())) variants.push_back(traversal);
  }
  for (const Variant& variant : variants) {
    INFO(variant.text());
    CHECK(difference(machine.render(scene, variant), oracle) == "");
  }
}

PLACE_TEST_CASE("A triangle beyond the guard band covers 4096 x 4096", "[limits]") {
  Scene scene;
  scene.width = scene.height = 4096;
  scene.clip = {{-100.0f, -90.0f, 0.25f, 1.0f}, {-80.0f, 300.0f, 0.5f, 1.0f}, {310.0f, -120.0f, 0.75f, 1.0f}};
  scene.triangles = {{0, 1, 2}};
  const oracle::Result oracle = oracle::render(scene);
  REQUIRE(oracle.counts.clipped == 1);
  REQUIRE(oracle.counts.covered == std::uint64_t{4096} * 4096);
  for (const Variant& variant : combinations({"binning"}, machine.info())) {
    INFO(variant.text());
    CHECK(difference(machine.render(scene, variant), oracle) == "");
  }
}
