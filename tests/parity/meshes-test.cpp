// Real and generated meshes against the oracle, from one pixel to 16 million.
#include "tests/support/meshes.h"

#include <fmt/format.h>
#include <tessera/input.h>

#include <catch2/catch.hpp>

#include "datasets/generators.h"
#include "tests/support/compare.h"
#include "tests/support/machines.h"
#include "tests/support/variants.h"

using namespace tessera;
using namespace tessera::test;

namespace {

struct Size {
  std::uint32_t width, height;
};

void checkAt(Machine& machine, const std::string& input, Size size, const Variant& variant = {}) {
  INFO(fmt::format("{}, {} x {}, {}", input, size.width, size.height, variant.text()));
  const Scene scene = loadInput(input, size.width, size.height);
  CHECK(difference(machine.render(scene, variant), oracle::render(scene)) == "");
}

std::vector<Size> sizesFor(const Machine& machine) {
  if (machine.isSwiftShader()) return {{199, 131}, {1, 1}};
  // By way of GLSL only where cells and tiles end within the raster: the other route to the same driver has them all.
  if (machine.route() == Route::kGlsl) return {{1009, 761}};
  return {{2048, 2048}, {1, 1}, {1, 4096}, {1009, 761}, {4096, 4096}};
}

}  // namespace

PLACE_AND_SWIFTSHADER_TEST_CASE("Real meshes have the oracle's bits", "[meshes]") {
  for (const char* name : {"refined_elephant.off", "bunny00.off"})
    for (const Size size : sizesFor(machine)) checkAt(machine, cgalMesh(name), size);
}

PLACE_AND_SWIFTSHADER_TEST_CASE("Real meshes have the oracle's bits without bins", "[meshes]") {
  const std::uint32_t extent = machine.isSwiftShader() ? 512 : 2048;
  for (const char* commit : {"depth32+id32", "two-pass"})
    if (machine.info().atomicMin64 || commit == std::string("two-pass"))
      checkAt(machine, cgalMesh("refined_elephant.off"), {extent, extent}, {{"binning", "none"}, {"commit", commit}});
}

PLACE_AND_SWIFTSHADER_TEST_CASE("Generated meshes have the oracle's bits", "[meshes]") {
  for (const datasets::Generator& generator : datasets::generators())
    for (const Size size : sizesFor(machine)) {
      if (machine.info().correctnessOnly && size.width == 4096) continue;  // seconds each: the real meshes are enough there
      // Their defaults once; at the other sizes they would take more time than all else together and show nothing that
      // this size does not.
      const bool light = size.width != 2048 || size.height != 2048;
      const char* fewer = light && generator.name == "hot" ? (machine.isSwiftShader() ? "?count=2000" : "?count=20000")
                          : light && generator.name == "layers" ? "?count=4"
                                                                : "";
      checkAt(machine, "generate:" + generator.name + fewer, size);
    }
}

PLACE_TEST_CASE("Each implementation value alone has the oracle's bits on a mesh and a hot tile and a fan", "[meshes]") {
  // Seconds a frame are too many for a software driver, which gets the same at a quarter of the extent and less of it.
  const bool software = machine.info().correctnessOnly;
  const std::uint32_t extent = software ? 128 : 512;
  for (const std::string& input : {cgalMesh(software ? "ChineseDragon-10kv.off" : "refined_elephant.off"),
                                   std::string(software ? "generate:hot?count=1000" : "generate:hot?count=50000"),
                                   std::string(software ? "generate:fan?count=1000" : "generate:fan?count=20000")}) {
    const Scene scene = loadInput(input, extent, extent);
    const oracle::Result oracle = oracle::render(scene);
    for (const Variant& variant : eachAlone({}, machine.info())) {
      INFO(input << ", " << variant.text());
      CHECK(difference(machine.render(scene, variant), oracle) == "");
    }
  }
}
