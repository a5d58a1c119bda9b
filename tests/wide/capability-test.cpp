// What is planned for a device without 64-bit types asks for none: no stage's SPIR-V declares one.
#include <tessera/error.h>
#include <tessera/kernel-cache.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

#include "host/kernels/spirv.h"
#include "host/plan/stages.h"
#include "tests/support/streams.h"

using namespace tessera;

namespace {

constexpr std::uint32_t kOpCapability = 17;
const std::set<std::uint32_t> kWideCapabilities{10, 11, 12};  // Float64, Int64, Int64Atomics

DeviceInfo device32() {
  DeviceInfo device;
  device.routes = {"spirv", "glsl"};
  device.name = "a 32-bit device";
  device.int64 = device.float64 = device.atomicMin64 = false;
  return device;
}

bool isWide(const CompiledKernel& kernel) {
  const std::vector<std::uint32_t> words = kernels::readSpirv(kernel.binary);
  return std::ranges::any_of(kernels::spirvInstructions(words), [](const kernels::SpirvInstruction& i) {
    return i.op == kOpCapability && kWideCapabilities.contains(i.operands[0]);
  });
}

}  // namespace

TEST_CASE("No stage for a device without 64-bit types declares one") {
  KernelCache kernels;
  for (const char* route : {"spirv", "glsl"})
    for (Variant variant : {Variant{{"plan", "full"}}, Variant{{"binning", "none"}}, Variant{{"edge", "int64"}}}) {
      variant.set("route", route);
      const Plan plan = makePlan(Scene{}, variant, device32());
      CHECK(plan.resolved.get("wide") == "two-word");
      for (const std::string& stage : plan.stages) {
        INFO(stage << ", " << variant.text());
        CHECK(!isWide(kernels.get(plan::kernelRequest(stage, plan))));
      }
    }
}

TEST_CASE("Native 64-bit integers are declared by the stage and refused without them") {
  KernelCache kernels;
  DeviceInfo device = device32();
  device.int64 = true;
  CHECK(isWide(kernels.get(plan::kernelRequest("setup", makePlan(Scene{}, {}, device)))));
  try {
    makePlan(Scene{}, {{"wide", "native"}}, device32());
    FAIL("no refusal");
  } catch (const Error& error) {
    CHECK(error.code() == ExitCode::kUnsupported);
    CHECK_THAT(error.what(),
               Catch::Contains("wide=native") && Catch::Contains("64-bit integers") && Catch::Contains("two-word"));
  }
}
