// Neither order nor the number of threads nor repetition changes a bit.
#include <fmt/format.h>
#include <tessera/cpu-device.h>
#include <tessera/input.h>

#include <algorithm>
#include <catch2/catch.hpp>

#include "datasets/random.h"
#include "tests/support/compare.h"
#include "tests/support/machines.h"
#include "tests/support/variants.h"

using namespace tessera;
using namespace tessera::test;

namespace {

/// Depth ties, shared edges, much overdraw, large and small triangles.
Scene crowdedScene() {
  Scene scene = loadInput("generate:soup?count=4000&pixels=2000", 300, 300);
  for (glm::vec3& p : scene.positions) p.z = std::floor(p.z * 64) / 64;
  append(scene, generateMesh("grid?columns=30&rows=30&angle=10"));
  append(scene, generateMesh("layers?count=4"));
  return scene;
}

/// Paths on which the order could show: each binning with each commit, and queues that overflow. Under a sanitizer, whose kernels
/// take several times as long to compile, and on a software driver each binning and each commit once.
std::vector<Variant> orderPaths(const DeviceInfo& device) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  const bool few = true;
#else
  const bool few = device.correctnessOnly;
#endif
  std::vector<Variant> paths = combinations(few ? std::vector<std::string>{"binning"} : std::vector<std::string>{"binning", "commit"}, device);
  if (few) {
    for (Variant& variant : combinations({"commit"}, device)) paths.push_back(std::move(variant));
    paths.push_back({{"binning", "none"}, {"commit", "two-pass"}});
  }
  paths.push_back({{"binning", "queue"}, {"capacity", "16"}, {"tile", "8"}});
  paths.push_back({{"binning", "exact"}, {"tile", "16"}, {"commit", "count"}});
  return paths;
}

}  // namespace

TEST_CASE("Shuffled workgroups and numbers of threads change no bit", "[order]") {
  const Scene scene = crowdedScene();
  const oracle::Result oracle = oracle::render(scene);
  for (const unsigned threads : {1u, 2u, 8u})
    for (const std::uint64_t seed : {0, 1, 2, 3}) {
      Machine machine("cpu", "cpp", makeCpuDevice({.threads = threads, .shuffleSeed = seed}));
      CHECK(machine.info().threads == threads);
      for (const Variant& variant : orderPaths(machine.info())) {
        INFO(fmt::format("{} threads, seed {}, {}", threads, seed, variant.text()));
        CHECK(difference(machine.render(scene, variant), oracle) == "");
      }
    }
}

PLACE_TEST_CASE("Twenty runs have the same bits", "[order]") {
  const Scene scene = crowdedScene();
  for (const Variant& variant : orderPaths(machine.info())) {
    INFO(variant.text());
    const Frame first = machine.render(scene, variant);
    for (int run = 1; run < 20; ++run) {
      const Frame frame = machine.render(scene, variant);
      CHECK(difference(frame.image, first.image) == "");
      CHECK(frame.counters == first.counters);
    }
  }
}

PLACE_TEST_CASE("The order of triangles changes ids and no depth", "[order]") {
  // Loose triangles of random depths, none of which are equal, so that the same one wins in any order.
  const Scene scene = loadInput("generate:soup?count=3000&pixels=2000", 300, 300);
  std::vector<std::uint32_t> order(scene.triangles.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  datasets::Random random(4);
  for (std::uint32_t i = static_cast<std::uint32_t>(order.size()); i > 1; --i)
    std::swap(order[i - 1], order[random.bits() % i]);
  Scene shuffled = scene;
  for (std::uint32_t i = 0; i < order.size(); ++i) shuffled.triangles[i] = scene.triangles[order[i]];

  for (const Variant& variant : combinations({"binning"}, machine.info())) {
    INFO(variant.text());
    const Framebuffer before = machine.render(scene, variant).image;
    Framebuffer after = machine.render(shuffled, variant).image;
    CHECK(after.ids != before.ids);
    for (std::uint32_t& id : after.ids)
      if (id != kNoTriangle) id = order[id];
    CHECK(difference(after, before) == "");
  }
}
