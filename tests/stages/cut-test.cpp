// Frames that the host has to cut into bands of rows and batches of triangles, for a device that has less: the bits of
// one piece.
#include <fmt/format.h>
#include <tessera/cpu-device.h>
#include <tessera/error.h>
#include <tessera/input.h>

#include <catch2/catch.hpp>

#include "tests/support/compare.h"
#include "tests/support/cut-device.h"
#include "tests/support/machines.h"
#include "tests/support/variants.h"

using namespace tessera;
using namespace tessera::test;

namespace {

/// 150 x 500 pixels, 2,606 triangles, some over most of the screen, in perspective and partly behind the eye.
Scene testScene() {
  Scene scene = loadInput("generate:torus?rings=40&sides=20", 150, 500);
  append(scene, generateMesh("layers?count=3"));
  append(scene, generateMesh("soup?count=1000&pixels=8000"));
  scene.clipFromObject = {1.7f, 0.3f, 0, 0.2f, 0.1f, -2.1f, 0.4f, 0, 0.2f, 0.3f, -1.01f, 0.6f, 0.2f, 0.3f, -1, 0.8f};
  return scene;
}

std::vector<Variant> paths(const DeviceInfo& device) {
  std::vector<Variant> all;
  for (const Variant& path : combinations({"binning", "commit"}, device)) {
    all.push_back(path);
    if (path.get("binning") == "queue") all.push_back(axes::joined(path, {{"capacity", "16"}, {"tile", "16"}}));
  }
  for (const Variant& binning : combinations({"binning"}, device))
    all.push_back(axes::joined(binning, {{"commit", "count"}}));
  return all;
}

Machine cutMachine(std::uint64_t bytes, std::uint32_t iterations = 0) {
  return {"cut", "cpp", makeCutDevice(makeCpuDevice(), bytes, iterations)};
}

}  // namespace

TEST_CASE("A device of small buffers gives the bits of a large one", "[cut]") {
  const Scene scene = testScene();
  const oracle::Result oracle = oracle::render(scene);
  Machine& whole = *machineAt<Cpu>();
  // 64 rows take 38,400 bytes of depth or 76,800 of packed words; 2,606 pieces take 104,240, and more where they are
  // clipped.
  for (const std::uint64_t bytes : {80000u, 160000u, 260000u}) {
    Machine cut = cutMachine(bytes);
    for (const Variant& variant : paths(cut.info())) {
      INFO(fmt::format("{} bytes, {}", bytes, variant.text()));
      const Frame frame = cut.render(scene, variant, {.countWork = true}),
                  one = whole.render(scene, variant, {.countWork = true});
      CHECK(one.counters.at("bands") == 1);
      CHECK(one.counters.at("batches") == 1);
      CHECK(frame.counters.at("bands") > 1);
      if (bytes == 80000) CHECK(frame.counters.at("batches") > 1);
      CHECK(difference(frame, oracle) == "");
      for (const char* cause : {"betweenSamples", "covered", "atomics", "overflowed"}) {
        INFO(cause);
        CHECK(frame.counters.at(cause) == one.counters.at(cause));
      }
    }
  }
}

TEST_CASE("Bands count what was dropped once, by facing too", "[cut]") {
  const Scene scene = testScene();
  Machine cut = cutMachine(160000);
  for (const char* cull : {"back", "front"}) {
    const Variant variant{{"cull", cull}};
    INFO(variant.text());
    const oracle::Result oracle = oracle::render(scene, oracle::imageAxesOf(variant));
    CHECK(oracle.counts.facing > 0);
    const Frame frame = cut.render(scene, variant);
    CHECK(frame.counters.at("bands") > 1);
    CHECK(difference(frame, oracle) == "");
  }
}

TEST_CASE("Shading survives bands and batches", "[cut]") {
  const Scene scene = testScene();
  Machine& whole = *machineAt<Cpu>();
  // 12 bytes of colour a pixel.
  Machine cut = cutMachine(12 * 150 * 64 + 64);
  for (const char* shade : {"id", "flat", "smooth"})
    for (const Variant& binning : combinations({"binning"}, cut.info())) {
      const Variant variant = axes::joined(binning, {{"shade", shade}});
      INFO(variant.text());
      const Frame frame = cut.render(scene, variant);
      CHECK(frame.counters.at("bands") == 8);
      CHECK(difference(frame.image, whole.render(scene, variant).image) == "");
    }
}

TEST_CASE("A device of short loops gives the bits of one of long ones", "[cut]") {
  const Scene scene = testScene();
  const oracle::Result oracle = oracle::render(scene);
  Machine cut = cutMachine(0, 2000);
  for (const Variant& variant : paths(cut.info())) {
    INFO(variant.text());
    const Frame frame = cut.render(scene, variant);
    CHECK(frame.counters.at("bands") > 1);
    CHECK(difference(frame, oracle) == "");
  }
}

TEST_CASE("Scenes that no cut can fit are refused", "[cut]") {
  const auto refusal = [](Machine& machine, const Scene& scene, const Variant& variant = {}) {
    try {
      machine.render(scene, variant);
    } catch (const Error& error) {
      CHECK(error.code() == ExitCode::kUnsupported);
      return std::string(error.what());
    }
    return std::string("no refusal");
  };
  Scene scene = loadInput("generate:grid?columns=40&rows=40", 64, 64);
  Machine small = cutMachine(17000);  // 1,681 vertices take 26,896 bytes in clip space
  CHECK_THAT(refusal(small, scene), Catch::Contains("1681 vertices take 26896 bytes") && Catch::Contains("17000"));
  scene.width = scene.height = 2048;
  Machine middle = cutMachine(1 << 20);
  CHECK_THAT(refusal(middle, scene, {{"binning", "queue"}, {"capacity", "65536"}, {"tile", "8"}}),
             Catch::Contains("capacity=65536") && Catch::Contains("set a smaller capacity or a larger tile"));
}
