// What each stage writes: equal on all machines, and as the oracle's where it has the same.
#include <tessera/input.h>

#include <bit>
#include <catch2/catch.hpp>
#include <cstring>

#include "tests/support/compare.h"
#include "tests/support/machines.h"
#include "tests/support/random-scene.h"
#include "tests/support/variants.h"

using namespace tessera;
using namespace tessera::test;

namespace {

bool isFinite(const Scene& scene) {
  for (const glm::vec4& c : oracle::transform(scene))
    for (int i = 0; i < 4; ++i)
      if (!std::isfinite(c[i])) return false;
  return true;
}

/// Random scenes without NaN, whose bits no rule of arithmetic fixes, and one that is clipped much.
std::vector<Scene> scenes() {
  std::vector<Scene> all{loadInput("generate:torus?rings=40&sides=20", 500, 300)};
  all.back().clipFromObject = {1.7f, 0.3f, 0,      0.2f, 0.1f, -2.1f, 0.4f, 0,
                               0.2f, 0.3f, -1.01f, 0.6f, 0.2f, 0.3f,  -1,   0.8f};
  for (std::uint64_t seed = 5000; all.size() < 40; ++seed)
    if (Scene scene = randomScene(seed); isFinite(scene)) all.push_back(std::move(scene));
  return all;
}

/// Whether its tiles keep lists of pieces, which are an output of their own.
bool hasLists(const Variant& variant) { return variant.get("binning") == "queue" || variant.get("binning") == "exact"; }

const StageOutput& output(const Frame& frame, const std::string& stage) {
  for (const StageOutput& s : frame.stages)
    if (s.stage == stage) return s;
  FAIL("no output of stage " << stage);
  return frame.stages.front();
}

}  // namespace

PLACE_TEST_CASE("Stages write the same on every machine", "[stages]") {
  Machine& cpu = *machineAt<Cpu>();
  for (const Scene& scene : scenes())
    for (const Variant& variant : combinations({"binning", "between-samples"}, machine.info())) {
      INFO(scene.name << ", " << variant.text());
      const Frame frame = machine.render(scene, variant, {.keepStages = true});
      CHECK(frame.stages.size() == (hasLists(variant) ? 5 : 4));
      CHECK(difference(frame.stages, cpu.render(scene, variant, {.keepStages = true}).stages) == "");
    }
}

PLACE_TEST_CASE("Stages write what the oracle has", "[stages]") {
  for (const Scene& scene : scenes()) {
    INFO(scene.name);
    const oracle::Result oracle = oracle::render(scene);
    const Frame frame = machine.render(scene, {}, {.keepStages = true});

    const std::vector<glm::vec4> clip = oracle::transform(scene);
    const StageOutput& transformed = output(frame, "transform");
    REQUIRE(transformed.values.size() == 4 * clip.size());
    CHECK(std::memcmp(transformed.values.data(), clip.data(), clip.size() * sizeof(glm::vec4)) == 0);

    // Each piece of setup is one of the oracle's; setup leaves those out that hold no sample of the raster.
    std::vector<std::array<std::uint32_t, 10>> expected;
    for (const oracle::Piece& p : oracle::pieces(scene, {})) {
      auto& e = expected.emplace_back();
      for (std::size_t i = 0; i < 3; ++i) {
        e[2 * i] = static_cast<std::uint32_t>(p.x[i]);
        e[2 * i + 1] = static_cast<std::uint32_t>(p.y[i]);
        e[6 + i] = std::bit_cast<std::uint32_t>(p.z[i]);
      }
      e[9] = p.id;
    }
    std::ranges::sort(expected);
    const StageOutput& setup = output(frame, "setup");
    REQUIRE(setup.words == 10);
    std::size_t pieces = 0, strangers = 0;
    for (std::size_t i = 0; i < setup.values.size(); i += 10) {
      std::array<std::uint32_t, 10> piece;
      std::copy_n(setup.values.begin() + static_cast<std::ptrdiff_t>(i), 10, piece.begin());
      if (piece[9] == kNoTriangle) continue;
      ++pieces;
      strangers += !std::ranges::binary_search(expected, piece);
    }
    CHECK(strangers == 0);
    CHECK(pieces == frame.counters.at("pieces"));
    CHECK(pieces + frame.counters.at("betweenSamples") + frame.counters.at("offScreen") == expected.size());

    Framebuffer raster = oracle.image;
    raster.hits.clear();
    for (const StageOutput& s : frame.stages) {
      if (s.element == "pixel, id") raster.ids = s.values;
      if (s.element == "pixel, depth") std::memcpy(raster.depth.data(), s.values.data(), 4 * s.values.size());
    }
    CHECK(difference(raster, oracle.image) == "");
  }
}
