#define CATCH_CONFIG_EXTERNAL_INTERFACES  // before Catch2 comes in: a listener below
#include "machines.h"

#include <tessera/cpu-device.h>
#include <tessera/vulkan-device.h>

#include <cstdlib>
#include <map>

namespace tessera::test {

Machine::Machine(std::string name, std::string route, std::unique_ptr<Device> device, KernelCache::Options options)
    : name_(std::move(name)),
      route_(std::move(route)),
      device_(std::move(device)),
      kernels_(std::move(options)),
      rasterizer_(*device_, kernels_) {}

Variant Machine::routed(Variant variant) const {
  if (!variant.has("route")) variant.set("route", route_);
  return variant;
}

Frame Machine::render(const Scene& scene, Variant variant, const FrameOptions& options) {
  return rasterizer_.render(scene, routed(std::move(variant)), options);
}

Plan Machine::plan(const Scene& scene, Variant variant) const {
  return makePlan(scene, routed(std::move(variant)), info());
}

namespace {

std::map<std::string, Machine> machines;

/// Devices end with the tests, not with the program: what the Vulkan loader and its layers keep may be gone by then.
struct Ending : Catch::TestEventListenerBase {
  using TestEventListenerBase::TestEventListenerBase;
  void testRunEnded(const Catch::TestRunStats& stats) override {
    TestEventListenerBase::testRunEnded(stats);
    machines.clear();
  }
};
CATCH_REGISTER_LISTENER(Ending)

}  // namespace

Machine* machineAt(const std::string& place, const std::string& route) {
  if (const auto found = machines.find(place); found != machines.end()) return &found->second;
  std::unique_ptr<Device> device;
  if (route == "cpp") {
    device = makeCpuDevice();
  } else {
    const char* without = std::getenv("TESSERA_NO_VULKAN");
    if (without != nullptr && std::string(without) == "1") {
      WARN("left out: TESSERA_NO_VULKAN=1");
      return nullptr;
    }
    VulkanOptions options;
    if (place == SwiftShader::kName) options.select = place;
#ifdef TESSERA_VALIDATION
    options.validation = true;
    options.onMessage = [](const std::string& message) { FAIL_CHECK(message); };
#endif
    device = makeVulkanDevice(options);  // throws, and so fails the test, where there is none
  }
  KernelCache::Options options;
  options.boundsChecks = place == CheckedCpu::kName;
  return &machines.try_emplace(place, place, route, std::move(device), options).first->second;
}

}  // namespace tessera::test
