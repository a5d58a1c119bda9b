// 500 random scenes against the oracle, 4,000 behind the label long: on each machine every scene, under variants that take turns.
#include <tessera/error.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "datasets/random.h"
#include "tests/support/compare.h"
#include "tests/support/machines.h"
#include "tests/support/random-scene.h"
#include "tests/support/variants.h"

using namespace tessera;
using namespace tessera::test;

namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr std::uint64_t kScenes = 100;  // the sanitizers look at each access, so they need fewer of them,
constexpr bool kFewPaths = true;         // and their kernels take several times as long to compile
#elif defined(TESSERA_MORE_SCENES)
constexpr std::uint64_t kScenes = 4000;
constexpr bool kFewPaths = false;
#else
constexpr std::uint64_t kScenes = 500;
constexpr bool kFewPaths = false;
#endif
/// On SwiftShader a few: nearly each frame compiles kernels of its own, a second of a core.
std::uint64_t scenesFor(const Machine& machine) { return machine.isSwiftShader() ? std::max<std::uint64_t>(20, kScenes / 25) : kScenes; }
/// Variants a scene: a CPU renders a small scene in a fraction of a millisecond, a software Vulkan driver takes tens of
/// times as long.
std::size_t variantsOfScene(const Machine& machine) {
  return machine.info().api == "cpu" ? 6 : machine.isSwiftShader() ? 2 : 3;
}

/// The axes that are no raster path, each value as often as the others where it goes with those before it.
Variant drawOthers(const Machine& machine, const Scene& scene, const Variant& path, datasets::Random& random) {
  Variant variant = path;
  for (const std::string& name : implementationAxes()) {
    if (variant.has(name)) continue;
    const auto values = losslessValues(axis(name));
    const std::string& value = values[random.bits() % values.size()];
    if (value.empty()) continue;
    const Variant more = axes::joined(variant, {{name, value}});
    try {
      machine.plan(scene, more);
    } catch (const Error&) {
      continue;
    }
    variant = more;
  }
  return variant;
}

/// Whether its arithmetic meets no denormal, which SwiftShader would flush: no product of a few of its coordinates is
/// one.
bool isMild(const Scene& scene) {
  const auto mild = [](float v) {
    return v == 0 || !std::isfinite(v) || (std::abs(v) > 0x1p-30f && std::abs(v) < 0x1p30f);
  };
  return std::ranges::all_of(scene.clip,
                             [&](const glm::vec4& c) { return mild(c.x) && mild(c.y) && mild(c.z) && mild(c.w); }) &&
         std::ranges::all_of(scene.positions,
                             [&](const glm::vec3& p) { return mild(p.x) && mild(p.y) && mild(p.z); }) &&
         std::ranges::all_of(scene.clipFromObject, mild);
}

}  // namespace

PLACE_AND_SWIFTSHADER_TEST_CASE("Random scenes have the oracle's bits under all variants", "[random]") {
  std::vector<Variant> paths = rasterPaths(machine.info());
  std::map<std::string, std::size_t> scenesOf;  // by "axis=value", and by path
  REQUIRE(paths.size() >= kImages);
  if (kFewPaths) paths.resize(kImages);
  std::size_t next = 0, failures = 0;
  for (std::uint64_t seed = 0; seed < scenesFor(machine) && failures < 3; ++seed) {
    const Scene scene = randomScene(seed);
    if (machine.isSwiftShader() && !isMild(scene)) continue;
    // Some paths have one interpolation only (size-class=shape), so each scene has a second image.
    const Variant image = randomImage(seed), cellPlane = axes::joined(image, {{"interpolate", "cell-plane"}});
    const oracle::Result oracle = oracle::render(scene, oracle::imageAxesOf(image));
    const oracle::Result oracleOfCellPlane = oracle::render(scene, oracle::imageAxesOf(cellPlane));
    datasets::Random random(seed);
    for (std::size_t i = 0; i < variantsOfScene(machine) && failures < 3; ++i, ++next) {
      // A path comes with one of the images only, so that it has one raster kernel.
      const std::size_t chosen = (next % (paths.size() / kImages + 1)) * kImages + seed % kImages;
      const Variant& path = paths[chosen < paths.size() ? chosen : seed % kImages];
      const bool fits = isAccepted(axes::joined(path, image), machine.info());
      const Variant variant = drawOthers(machine, scene, axes::joined(path, fits ? image : cellPlane), random);
      INFO(scene.name << ", " << scene.width << " x " << scene.height << ", " << variant.text());
      const std::string different = difference(machine.render(scene, variant), fits ? oracle : oracleOfCellPlane);
      CHECK(different == "");
      failures += !different.empty();
      ++scenesOf[path.text()];
      for (const auto& [name, value] : variant.values()) ++scenesOf[name + "=" + value];
    }
  }
  if (failures > 0) return;
  if (machine.isSwiftShader()) {
    CHECK(next >= 20);  // of the scenes some are not mild
    return;
  }
  for (const auto& [what, scenes] : scenesOf) {
    INFO(what);
    const bool single = what.find(' ') == std::string::npos;
    CHECK(1000 * scenes >= (single ? 100u : 30u) * kScenes);
  }
}
