#include "bench/scenes.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <tessera/error.h>
#include <tessera/input.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>

#include "host/build-info.h"

namespace tessera::bench {

const std::vector<BenchScene>& scenes() {
  static const std::vector<BenchScene> list{
      {"elephant", TESSERA_ELEPHANT},
      {"sphere", "generate:icosphere?level=8"},
      {"layers-far-to-near", "generate:layers?count=64&order=far-to-near"},
      {"layers-near-to-far", "generate:layers?count=64&order=near-to-far"},
  };
  return list;
}

Scene load(const BenchScene& scene, std::uint32_t width, std::uint32_t height) {
  if (scene.name == "elephant" && !std::filesystem::exists(scene.input))
    failUsage(fmt::format("{}: not there: install Debian's libcgal-demo, then configure and build again", scene.input));
  return loadInput(scene.input, width, height);
}

std::vector<std::pair<std::string, std::string>> provenance(const DeviceInfo& device, const KernelCache& kernels) {
  double load[1] = {-1};
  getloadavg(load, 1);
  const auto now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  return {{"tessera_build", TESSERA_BUILD_TYPE},
          {"git", TESSERA_GIT},
          {"compiler", TESSERA_COMPILER},
          {device.threads != 0 ? "cpu" : "device", device.name},
          {"threads", std::to_string(device.threads)},
          {"slang", kernels.slangc().version},
          {"kernel_compiler", kernels.cxx()},
          {"load_average", fmt::format("{:.2f}", load[0])},
          {"utc", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now))}};
}

}  // namespace tessera::bench
