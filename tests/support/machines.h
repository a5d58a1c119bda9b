// The machines that a test runs on: a test is written once as PLACE_TEST_CASE and registered for each.
#pragma once

#include <tessera/device.h>
#include <tessera/kernel-cache.h>
#include <tessera/rasterizer.h>

#include <catch2/catch.hpp>
#include <memory>
#include <string>

#include "host/axes/routes.h"

namespace tessera::test {

struct Cpu {
  static constexpr const char* kName = "cpu";
  static constexpr const char* kRoute = "cpp";
};
struct VulkanSpirv {
  static constexpr const char* kName = "vulkan by spirv";
  static constexpr const char* kRoute = "spirv";
};
struct VulkanGlsl {
  static constexpr const char* kName = "vulkan by glsl";
  static constexpr const char* kRoute = "glsl";
};
/// A second software driver, independent of the first: no 64-bit integers or floats, subgroups of 4, denormals flushed.
struct SwiftShader {
  static constexpr const char* kName = "SwiftShader";
  static constexpr const char* kRoute = "spirv";
};
/// The CPU with Slang's bounds checks compiled into the kernels: an access out of bounds throws.
struct CheckedCpu {
  static constexpr const char* kName = "cpu with bounds checks";
  static constexpr const char* kRoute = "cpp";
};

class Machine {
 public:
  Machine(std::string name, std::string route, std::unique_ptr<Device> device, KernelCache::Options options = {});

  const std::string& name() const { return name_; }
  bool isSwiftShader() const { return name_ == SwiftShader::kName; }  ///< for tests to take on less there
  Device& device() { return *device_; }
  const DeviceInfo& info() const { return device_->info(); }
  KernelCache& kernels() { return kernels_; }
  Route route() const { return axes::routeNamed(route_).route; }
  /// Renders with this machine's route, unless the variant says another.
  Frame render(const Scene& scene, Variant variant = {}, const FrameOptions& options = {});
  Plan plan(const Scene& scene, Variant variant = {}) const;

 private:
  Variant routed(Variant variant) const;

  std::string name_, route_;
  std::unique_ptr<Device> device_;
  KernelCache kernels_;
  Rasterizer rasterizer_;  // after what it uses
};

/// One machine of each place for the whole program, so that kernels are loaded once. A test fails where there is no
/// Vulkan device, or no SwiftShader. With TESSERA_NO_VULKAN=1 in the environment it warns instead, and null comes back.
Machine* machineAt(const std::string& place, const std::string& route);
template <typename Place>
Machine* machineAt() {
  return machineAt(Place::kName, Place::kRoute);
}

}  // namespace tessera::test

/// PLACE_TEST_CASE(title, tags) { ... `machine` ... }: a test case on each machine.
#define PLACE_TEST_CASE_AT(run, title, tags, ...)                                 \
  static void run(tessera::test::Machine& machine);                               \
  TEMPLATE_TEST_CASE(title, tags, __VA_ARGS__) {                                  \
    if (tessera::test::Machine* machine = tessera::test::machineAt<TestType>()) { \
      INFO("on " << machine->name());                                             \
      run(*machine);                                                              \
    }                                                                             \
  }                                                                               \
  static void run(tessera::test::Machine& machine)
#define PLACE_TEST_CASE(title, tags)                                                                                 \
  PLACE_TEST_CASE_AT(INTERNAL_CATCH_UNIQUE_NAME(runAt), title, tags, tessera::test::Cpu, tessera::test::VulkanSpirv, \
                     tessera::test::VulkanGlsl)
/// The same, and once more with bounds checks in the CPU's kernels.
#define CHECKED_PLACE_TEST_CASE(title, tags)                                                                        \
  PLACE_TEST_CASE_AT(INTERNAL_CATCH_UNIQUE_NAME(runAt), title, tags, tessera::test::Cpu, tessera::test::CheckedCpu, \
                     tessera::test::VulkanSpirv, tessera::test::VulkanGlsl)
/// The same as these two, and on SwiftShader: tens of times slower than the CPU device, so for what is small.
#define PLACE_AND_SWIFTSHADER_TEST_CASE(title, tags)                                                                 \
  PLACE_TEST_CASE_AT(INTERNAL_CATCH_UNIQUE_NAME(runAt), title, tags, tessera::test::Cpu, tessera::test::VulkanSpirv, \
                     tessera::test::VulkanGlsl, tessera::test::SwiftShader)
#define CHECKED_PLACE_AND_SWIFTSHADER_TEST_CASE(title, tags)                                                        \
  PLACE_TEST_CASE_AT(INTERNAL_CATCH_UNIQUE_NAME(runAt), title, tags, tessera::test::Cpu, tessera::test::CheckedCpu, \
                     tessera::test::VulkanSpirv, tessera::test::VulkanGlsl, tessera::test::SwiftShader)
