// 1,000 random scenes against the oracle: on each machine every scene, under variants that take turns.
#include <catch2/catch.hpp>
#include <map>

#include "datasets/random.h"
#include "tests/support/compare.h"
#include "tests/support/machines.h"
#include "tests/support/random-scene.h"
#include "tests/support/variants.h"

using namespace tessera;

namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr std::uint64_t kScenes = 100;  // the sanitizers look at each access, so they need fewer of them
#else
constexpr std::uint64_t kScenes = 1000;
#endif
/// Variants a scene: a CPU renders a small scene in a fraction of a millisecond, a software Vulkan driver takes tens of
/// times as long.
std::size_t variantsOfScene(const Machine& machine) { return machine.info().api == "cpu" ? 24 : 6; }

/// The axes that are no raster path, each value as often as the others.
Variant drawOthers(const Variant& path, Random& random) {
  Variant variant = path;
  for (const std::string& name : implementationAxes()) {
    if (variant.has(name) || (name == "tile" && path.get("binning") == "none")) continue;
    const auto values = losslessValues(axis(name));
    const std::string& value = values[random.bits() % values.size()];
    if (!value.empty()) variant.set(name, value);
  }
  return variant;
}

}  // namespace

PLACE_TEST_CASE("Random scenes have the oracle's bits under all variants", "[random]") {
  const std::vector<Variant> paths = rasterPaths(machine.info());
  std::map<std::string, std::size_t> scenesOf;  // by "axis=value", and by path
  std::size_t next = 0, failures = 0;
  for (std::uint64_t seed = 0; seed < kScenes && failures < 3; ++seed) {
    const Scene scene = randomScene(seed);
    const Variant image = randomImage(seed);
    const reference::Result oracle = reference::render(scene, imageOf(image));
    Random random(seed);
    for (std::size_t i = 0; i < variantsOfScene(machine) && failures < 3; ++i, ++next) {
      const Variant& path = paths[next % paths.size()];
      const Variant variant = joined(drawOthers(path, random), image);
      INFO(scene.name << ", " << scene.width << " x " << scene.height << ", " << variant.text());
      const std::string different = difference(machine.render(scene, variant), oracle);
      CHECK(different == "");
      failures += !different.empty();
      ++scenesOf[path.text()];
      for (const auto& [name, value] : variant.values()) ++scenesOf[name + "=" + value];
    }
  }
  if (failures > 0) return;
  for (const auto& [what, scenes] : scenesOf) {
    INFO(what);
    const bool single = what.find(' ') == std::string::npos;
    CHECK(scenes * (1000 / kScenes) >= (machine.info().api == "cpu" || single ? 200u : 50u));
  }
}
