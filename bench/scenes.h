// What the benchmarks render, and what they say about this build and machine.
#pragma once

#include <tessera/device.h>
#include <tessera/kernel-cache.h>
#include <tessera/scene.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace tessera::bench {

struct BenchScene {
  std::string name;
  std::string input;  ///< for loadInput()
};

/// A real mesh of 88,928 triangles, a sphere of 1,310,720, and 64 layers over the whole screen in both orders.
const std::vector<BenchScene>& scenes();
/// Throws kUsage, naming the scenes there are, or saying where the real mesh comes from.
Scene load(const BenchScene& scene, std::uint32_t width, std::uint32_t height);

/// Build, commit, device, threads (0 on Vulkan) and compilers, as names and values.
std::vector<std::pair<std::string, std::string>> provenance(const DeviceInfo& device, const KernelCache& kernels);

}  // namespace tessera::bench
