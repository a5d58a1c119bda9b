// The attribute stage against the oracle, bit for bit: on each machine, in perspective and not, whole and cut.
#include <tessera/cpu-device.h>
#include <tessera/error.h>
#include <tessera/input.h>

#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "datasets/random.h"
#include "tests/support/compare.h"
#include "tests/support/cut-device.h"
#include "tests/support/machines.h"
#include "tests/support/random-scene.h"
#include "tests/support/streams.h"
#include "tests/support/variants.h"

using namespace tessera;
using namespace tessera::test;

namespace {

/// A value a vertex: over many orders of magnitude, some equal, in one scene of four some that are not finite.
void addValues(Scene& scene, std::uint64_t seed) {
  datasets::Random random(seed);
  const float strange[] = {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN(),
                           std::numeric_limits<float>::max(), std::numeric_limits<float>::denorm_min()};
  nameAttribute(scene, "random");
  for (std::size_t v = 0; v < scene.vertexCount(); ++v) {
    const double scale = std::ldexp(1.0, static_cast<int>(random.bits() % 40) - 20);
    auto value = static_cast<float>(random.between(-scale, scale));
    if (random.bits() % 8 == 0) value = 3;
    if (seed % 4 == 0 && random.bits() % 16 == 0) value = strange[random.bits() % 4];
    attributeOf(scene).push_back(value);
  }
}

}  // namespace

CHECKED_PLACE_TEST_CASE("Values of random scenes have the oracle's bits", "[attributes]") {
  const Variant variants[] = {{},
                              {{"binning", "none"}},
                              {{"plan", "full"}},
                              {{"cull", "back"}, {"wide", "two-word"}},
                              {{"fill", "inclusive"}, {"sub-pixel", "0"}},
                              {{"sub-pixel", "4"}, {"interpolate", "weights"}},
                              {{"sub-pixel", "6"}, {"interpolate", "plane"}},
                              {{"fill", "inclusive"}, {"clip", "on"}}};
  // With bounds checks the first four, which index as the others do: each is a raster kernel more to compile.
  const std::size_t count = machine.name() == CheckedCpu::kName ? 4 : std::size(variants);
  std::size_t values = 0, failures = 0;
  for (std::uint64_t seed = 0; seed < 120 && failures < 3; ++seed) {
    Scene scene = randomScene(seed);
    addValues(scene, seed);
    const Variant& variant = variants[seed % count];
    CAPTURE(scene.name, seed, variant.text());
    const oracle::Result oracle = oracle::render(scene, oracle::imageAxesOf(variant));
    const Frame frame = machine.render(scene, variant);
    REQUIRE(valuesOf(frame.image).size() == frame.image.pixels());
    const std::string different = difference(frame, oracle);
    CHECK(different == "");
    failures += !different.empty();
    for (const float value : valuesOf(frame.image)) values += std::isfinite(value);
  }
  CHECK(values > 100'000);
}

TEST_CASE("Values do not depend on how the host cuts a frame", "[attributes]") {
  Scene scene = loadInput("generate:torus?rings=40&sides=20", 150, 500);
  append(scene, generateMesh("soup?count=1000&pixels=8000"));
  scene.clipFromObject = {1.7f, 0.3f, 0, 0.2f, 0.1f, -2.1f, 0.4f, 0, 0.2f, 0.3f, -1.01f, 0.6f, 0.2f, 0.3f, -1, 0.8f};
  for (const glm::vec3& p : scene.positions) attributeOf(scene).push_back(p.x + p.y);
  const oracle::Result oracle = oracle::render(scene);
  Machine cut("cut", "cpp", makeCutDevice(makeCpuDevice(), 80000, 0));
  for (const char* const binning : {"exact", "none"}) {
    const Frame frame = cut.render(scene, {{"binning", binning}});
    CHECK(frame.counters.at("bands") > 1);
    CHECK(frame.counters.at("batches") > 1);
    CHECK(frame.counters.at("clipped") > 0);
    CHECK(difference(frame, oracle) == "");
  }
}

PLACE_TEST_CASE("The attribute stage runs only where values were asked for", "[attributes]") {
  Scene scene = loadInput("generate:grid?columns=4&rows=4", 64, 64);
  const auto entry = [](const Plan& plan) {
    return *std::ranges::find(plan.entries, std::string("attribute"), &PlanEntry::pass);
  };
  const Frame without = machine.render(scene);
  CHECK(valuesOf(without.image).empty());
  CHECK_FALSE(entry(without.plan).kept);
  CHECK(entry(without.plan).why.find("no values asked for") != std::string::npos);
  attributeOf(scene).assign(scene.vertexCount(), 2.5f);
  const Frame with = machine.render(scene);
  CHECK(entry(with.plan).kept);
  for (std::size_t k = 0; k < with.image.pixels(); ++k) {
    const bool empty = with.image.ids[k] == kNoTriangle;
    CHECK(std::bit_cast<std::uint32_t>(valuesOf(with.image)[k]) ==
          (empty ? 0x7fc00000u : std::bit_cast<std::uint32_t>(2.5f)));
  }
  CHECK(difference(Framebuffer{with.image.width, with.image.height, with.image.depth, with.image.ids, {}, {}, {}},
                   without.image) == "");
}

PLACE_TEST_CASE("Values that do not fit the scene or the commit are refused", "[attributes]") {
  Scene scene = loadInput("generate:grid?columns=4&rows=4", 64, 64);
  nameAttribute(scene, "height");
  const auto message = [&](const Variant& variant) -> std::string {
    try {
      machine.render(scene, variant);
    } catch (const Error& error) {
      CHECK(error.code() == ExitCode::kUsage);
      return error.what();
    }
    return "";
  };
  attributeOf(scene).assign(3, 0.0f);
  CHECK(message({}) == "attribute height: 3 values for 25 vertices; one a vertex would be right");
  attributeOf(scene).assign(scene.vertexCount(), 0.0f);
  CHECK(message({{"commit", "count"}}).starts_with("attribute height: commit=count"));
}
