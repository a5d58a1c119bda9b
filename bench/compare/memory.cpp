#include <fmt/format.h>
#include <tessera/cpu-device.h>
#include <tessera/error.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "bench/compare/measure.h"
#include "host/support/subprocess.h"

namespace tessera::bench {
namespace {

/// The most memory that this process held at once since its exec. getrusage would count that of the process which started it, too.
std::uint64_t peakResident() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (std::uint64_t kib = 0; line.starts_with("VmHWM:") && std::istringstream(line.substr(6)) >> kib) return kib * 1024;
  fail("/proc/self/status: no line VmHWM");
}

}  // namespace

void printMemory(const std::string& name, std::uint32_t size, unsigned threads) {
  const auto scene = std::ranges::find(scenes(), name, &BenchScene::name);
  if (scene == scenes().end()) failUsage(fmt::format("--memory-of {}: no such scene", name));
  KernelCache kernels;
  const auto device = makeCpuDevice({.threads = threads});
  Rasterizer rasterizer(*device, kernels);
  const Frame frame = rasterizer.render(load(*scene, size, size));
  fmt::print("{} {}\n", peakResident(), device->peakBufferBytes());
}

Memory measureMemory(const std::string& scene, std::uint32_t size, unsigned threads) {
  const support::ProcessResult result = support::runProcess(
      {"/proc/self/exe", "--memory-of", scene, "--size", std::to_string(size), "--threads", std::to_string(threads)});
  Memory memory;
  memory.scene = scene;
  if (!result.ok() || !(std::istringstream(result.output) >> memory.peakResident >> memory.peakBuffers))
    fail(fmt::format("measuring the memory of {}: {}", scene, result.output));
  return memory;
}

}  // namespace tessera::bench
