// Watertight: a sample inside a closed mesh is hit exactly once, on each path.
#include <fmt/format.h>
#include <tessera/input.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "tests/support/compare.h"
#include "tests/support/machines.h"
#include "tests/support/variants.h"

using namespace tessera;
using namespace tessera::test;

namespace {

/// Whether a sample lies inside the mesh and at least a pixel from its border; at least a pixel outside of it.
struct Region {
  std::function<bool(double x, double y)> inside, outside;
};

void checkHits(Machine& machine, const Scene& scene, const Region& region, const std::vector<Variant>& paths) {
  const oracle::Result oracle = oracle::render(scene);
  for (const Variant& path : paths) {
    const Variant variant = axes::joined(path, {{"commit", "count"}});
    INFO(scene.name << ", " << variant.text());
    const Frame frame = machine.render(scene, variant, {.countWork = true});
    std::size_t inside = 0, zero = 0, more = 0, strays = 0;
    for (std::uint32_t j = 0; j < scene.height; ++j)
      for (std::uint32_t i = 0; i < scene.width; ++i) {
        const std::uint32_t hits = frame.image.hits[std::size_t{j} * scene.width + i];
        const double x = i + 0.5, y = j + 0.5;
        if (region.inside(x, y)) {
          ++inside;
          zero += hits == 0;
          more += hits > 1;
        } else if (region.outside(x, y)) {
          strays += hits > 0;
        }
      }
    CHECK(inside > scene.width * scene.height / 4);
    CHECK(zero == 0);
    CHECK(more == 0);
    CHECK(strays == 0);
    CHECK(difference(frame, oracle) == "");
    CHECK(frame.counters.at("covered") == oracle.counts.covered);
  }
}

std::vector<Variant> allPaths(const Machine& machine) { return eachAlone({{"commit", "count"}}, machine.info()); }
std::vector<Variant> binnings(const Machine& machine) { return combinations({"binning"}, machine.info()); }

}  // namespace

PLACE_AND_SWIFTSHADER_TEST_CASE("A closed fan of 100000 triangles is hit once", "[hits]") {
  // On SwiftShader a hundredth, and a quarter of the extent.
  const bool less = machine.isSwiftShader();
  const std::uint32_t extent = less ? 128 : 512;
  const double centre = extent / 2;
  const Scene scene = loadInput(less ? "generate:fan?count=1000" : "generate:fan?count=100000", extent, extent);
  const double radius = 0.95 * centre;
  const auto distance = [&](double x, double y) { return std::hypot(x - centre, y - centre); };
  // The fan's rim is a polygon, which leaves its circle by less than a thousandth of a pixel; its
  // corners are snapped.
  checkHits(
      machine, scene,
      {[&](double x, double y) { return distance(x, y) < radius - 1; },
       [&](double x, double y) { return distance(x, y) > radius + 1; }},
      less                             ? binnings(machine)
      : machine.info().correctnessOnly ? std::vector<Variant>{{{"binning", "exact"}}, {{"binning", "none"}}}  // seconds each
                                       : allPaths(machine));
}

PLACE_AND_SWIFTSHADER_TEST_CASE("A turned grid is hit once", "[hits]") {
  const bool less = machine.isSwiftShader();
  const std::uint32_t extent = less ? 128 : 512;
  const double angle = 30.7, centre = extent / 2, half = 0.7 * centre;
  const Scene scene = loadInput(
      fmt::format("generate:grid?columns={}&rows={}&angle={}", less ? 25 : 100, less ? 19 : 77, angle), extent, extent);
  const double c = std::cos(angle * M_PI / 180), s = std::sin(angle * M_PI / 180);
  const auto fromCentre = [&](double x, double y) {
    const double dx = x - centre, dy = y - centre;
    return std::max(std::abs(dx * c + dy * s), std::abs(dy * c - dx * s));
  };
  checkHits(machine, scene,
            {[&](double x, double y) { return fromCentre(x, y) < half - 1; },
             [&](double x, double y) { return fromCentre(x, y) > half + 1; }},
            less ? binnings(machine) : allPaths(machine));
}

PLACE_TEST_CASE("A clipped pair that shares an edge is hit once", "[hits]") {
  // A ground from behind the eye to w = 20: y = 1.3 at any distance, so that the screen shows it below y = 1.3 / 20.
  // Its diagonal crosses the near plane, and in the second case the guard band on both sides: at w = 1 it is 3000
  // screens wide.
  for (const float side : {40.0f, 3000.0f}) {
    Scene scene;
    scene.name = fmt::format("ground {} wide", 2 * side);
    scene.width = scene.height = 512;
    for (const float w : {-5.3f, 20.0f})
      for (const float x : {-side, side}) scene.clip.emplace_back(x, 1.3f, (w - 1.01f) * 1.01f, w);
    scene.triangles = {{0, 1, 2}, {3, 2, 1}};
    const double horizon = 256 + 256 * 1.3 / 20;
    checkHits(machine, scene,
              {[&](double, double y) { return y > horizon + 1; }, [&](double, double y) { return y < horizon - 1; }},
              allPaths(machine));
  }
}
