// The start-up probe passes on the CPU, and sees what it is there to see.
#include "host/probe.h"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "host/cpu/cpu-device.h"
#include "host/kernel-cache.h"
#include "host/vulkan/vulkan-device.h"

using namespace tessera;
namespace fs = std::filesystem;

namespace {

std::vector<std::string> failing(const Probe& probe) {
  std::vector<std::string> names;
  for (const auto& result : probe.results)
    if (!result.passed) names.push_back(result.name + ": " + result.detail);
  return names;
}

const ProbeResult& row(const Probe& probe, const std::string& name) {
  for (const auto& result : probe.results)
    if (result.name == name) return result;
  FAIL("no row " << name);
  std::abort();
}

/// The kernels' sources with `from` replaced by `to` in one file, in a folder of its own.
class Altered {
 public:
  Altered(const std::string& file, const std::string& from, const std::string& to)
      : folder_(fs::temp_directory_path() / ("tessera-probe-test-" + std::to_string(getpid()))) {
    fs::copy(TESSERA_SOURCE_DIR "/slang", folder_, fs::copy_options::recursive);
    std::stringstream text;
    text << std::ifstream(folder_ / file).rdbuf();
    std::string changed = text.str();
    REQUIRE(changed.find(from) != std::string::npos);
    changed.replace(changed.find(from), from.size(), to);
    std::ofstream(folder_ / file) << changed;
  }
  ~Altered() { fs::remove_all(folder_); }
  Altered(const Altered&) = delete;

  Probe probe(Device& device, Route route) const {
    KernelCache::Options options;
    options.slangSources = folder_;
    KernelCache kernels(options);
    return probeDevice(device, kernels, route);
  }

 private:
  fs::path folder_;
};

}  // namespace

TEST_CASE("the probe passes on the CPU device") {
  KernelCache kernels;
  const auto device = makeCpuDevice();
  const Probe probe = probeDevice(*device, kernels, Route::kCpp);
  CHECK(failing(probe) == std::vector<std::string>{});
  CHECK(probe.passed());
  CHECK(probe.results.size() == 18);
}

TEST_CASE("the probe passes on lavapipe by both routes") {
  KernelCache kernels;
  VulkanOptions options;
  options.select = "llvmpipe";
  options.validation = true;
  std::vector<std::string> messages;
  options.onMessage = [&](const std::string& message) { messages.push_back(message); };
  const auto device = makeVulkanDevice(options);
  for (Route route : {Route::kSpirv, Route::kGlsl}) {
    const Probe probe = probeDevice(*device, kernels, route);
    CHECK(failing(probe) == std::vector<std::string>{});
    CHECK(!row(probe, "loop-limit").required);
    CHECK(row(probe, "loop-limit").detail != "");
  }
  CHECK(messages == std::vector<std::string>{});
}

TEST_CASE("the probe sees a division by way of the reciprocal") {
  const Altered sources("exact-math.slang", "return a / b;", "return a * (1.0f / b);");
  const auto device = makeCpuDevice();
  const Probe probe = sources.probe(*device, Route::kCpp);
  CHECK(!probe.passed());
  CHECK(!row(probe, "divide").passed);
  CHECK_THAT(row(probe, "divide").detail, Catch::StartsWith("a / b with a 0x"));
  CHECK(row(probe, "multiply").passed);
}

TEST_CASE("the probe sees a fused product and sum") {
  const Altered sources("probe.slang", "a * b + c", "fma(a, b, c)");
  const auto device = makeCpuDevice();
  const Probe probe = sources.probe(*device, Route::kCpp);
  CHECK(!row(probe, "contraction").passed);
  CHECK(row(probe, "add").passed);
  CHECK(row(probe, "multiply").passed);
}

TEST_CASE("the probe sees denormals flushed to zero and does not blame the operation") {
  const Altered sources("probe.slang", "asuint(a + b)",
                        "(asuint(a + b) & 0x7f800000u) == 0u ? asuint(a + b) & 0x80000000u : asuint(a + b)");
  const auto device = makeCpuDevice();
  const Probe probe = sources.probe(*device, Route::kCpp);
  CHECK(!row(probe, "denormals").passed);
  CHECK(row(probe, "add").passed);
}

TEST_CASE("the probe sees a wide integer rounded twice") {
  const Altered sources("fixed-point.slang", "return float(a);",
                        "return float(int(a >> 32)) * 4294967296.0f + float(uint(a));");
  const auto device = makeCpuDevice();
  const Probe probe = sources.probe(*device, Route::kCpp);
  CHECK(!row(probe, "int64-to-float").passed);
  CHECK(row(probe, "int64-product").passed);
}
