// Each implementation value alone on SwiftShader, whose compiler takes a second and more over each raster kernel.
#include <tessera/input.h>

#include <catch2/catch.hpp>

#include "tests/support/compare.h"
#include "tests/support/machines.h"
#include "tests/support/variants.h"

using namespace tessera;
using namespace tessera::test;

TEST_CASE("Each implementation value alone has the oracle's bits on SwiftShader", "[swiftshader]") {
  Machine* const machine = machineAt<SwiftShader>();
  if (machine == nullptr) return;
  for (const char* const input : {"generate:icosphere?level=3", "generate:hot?count=500", "generate:fan?count=500"}) {
    const Scene scene = loadInput(input, 96, 96);
    const oracle::Result oracle = oracle::render(scene);
    for (const Variant& variant : eachAlone({}, machine->info())) {
      INFO(input << ", " << variant.text());
      CHECK(difference(machine->render(scene, variant), oracle) == "");
    }
  }
}
