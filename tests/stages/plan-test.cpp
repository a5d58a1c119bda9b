// What the plan leaves out: the same bits without it, and each switch seen in both positions.
#include <tessera/input.h>

#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "tests/support/compare.h"
#include "tests/support/machines.h"
#include "tests/support/random-scene.h"
#include "tests/support/variants.h"

using namespace tessera;
using namespace tessera::test;

namespace {

constexpr std::uint64_t kFirstSeed = 7000, kScenes = 200;

std::set<std::string> left(const Plan& plan) {
  std::set<std::string> names;
  for (const PlanEntry& entry : plan.entries)
    if (!entry.kept) names.insert(entry.pass);
  return names;
}

bool ran(const Frame& frame, const std::string& stage) {
  for (const auto& [name, time] : frame.times.stages)
    if (name == stage) return true;
  return false;
}

}  // namespace

PLACE_TEST_CASE("The planned pipeline has the bits of the full one", "[plan]") {
  std::map<std::string, std::set<bool>> seen;  // kept or left out, by pass
  for (std::uint64_t seed = kFirstSeed; seed < kFirstSeed + kScenes; ++seed) {
    const Scene scene = randomScene(seed);
    INFO(scene.name);
    const Frame planned = machine.render(scene, {{"plan", "planned"}}),
                full = machine.render(scene, {{"plan", "full"}});
    CHECK(difference(planned.image, full.image) == "");
    for (const PlanEntry& entry : planned.plan.entries) {
      CHECK(entry.why != "");
      CHECK(entry.why.find('\n') == std::string::npos);
      seen[entry.pass].insert(entry.kept);
    }
    // The full one leaves nothing out that is not asked for by an axis or has no input.
    for (const PlanEntry& entry : full.plan.entries)
      if (entry.pass == "setup: clip" || entry.pass == "project: perspective division" || entry.pass == "clear")
        CHECK(entry.kept);
    CHECK(ran(full, "clear"));
    CHECK(ran(planned, "clear") == !left(planned.plan).contains("clear"));
    CHECK(ran(planned, "transform") == !left(planned.plan).contains("transform"));
  }
  for (const char* pass : {"transform", "setup: clip", "project: perspective division"}) {
    INFO(pass);
    CHECK(seen[pass] == std::set<bool>{false, true});
  }
}

PLACE_TEST_CASE("Each switch of the plan alone changes no bit", "[plan]") {
  for (std::uint64_t seed = kFirstSeed; seed < kFirstSeed + 60; ++seed) {
    const Scene scene = randomScene(seed);
    INFO(scene.name);
    const Frame full = machine.render(scene, {{"plan", "full"}});
    const Plan planned = machine.plan(scene);
    // What the planner found it can leave out, one at a time in the full pipeline.
    for (const char* axis : {"clip", "projection", "between-samples"}) {
      const Variant variant{{"plan", "full"}, {axis, planned.resolved.get(axis)}};
      INFO(variant.text());
      CHECK(difference(machine.render(scene, variant).image, full.image) == "");
    }
  }
}

PLACE_TEST_CASE("Passes are kept where an axis asks for them", "[plan]") {
  const Scene scene = loadInput("generate:icosphere?level=2", 100, 100);
  const auto without = [&](const Variant& variant) { return left(machine.plan(scene, variant)); };
  CHECK(without({}).contains("shade"));
  CHECK(!without({{"shade", "flat"}}).contains("shade"));
  CHECK(without({{"shade", "flat"}}).contains("normals"));
  CHECK(!without({{"shade", "smooth"}}).contains("normals"));
  CHECK(without({}).contains("resolve"));
  CHECK(!without({{"commit", "depth32+id32"}}).contains("resolve"));
  CHECK(without({}).contains("clear"));
  CHECK(!without({{"commit", "two-pass"}}).contains("clear"));
  CHECK(without({}).contains("setup: cull by facing"));
  CHECK(!without({{"cull", "back"}}).contains("setup: cull by facing"));
  CHECK(!without({}).contains("bin-insert"));
  CHECK(without({{"binning", "none"}}).contains("bin-insert"));
  CHECK(without({{"binning", "queue"}}).contains("bin-count, scan"));
  CHECK(!without({}).contains("setup: drop between samples"));
  CHECK(without({{"plan", "full"}}).contains("setup: drop between samples"));
}

PLACE_TEST_CASE("A plan sets every axis", "[plan]") {
  const Plan plan = machine.plan(loadInput("generate:icosphere?level=2", 100, 100));
  for (const Axis& axis : allAxes()) {
    INFO(axis.name);
    CHECK(plan.resolved.has(axis.name));
  }
}
