// The start-up probe passes on the CPU, and sees what it is there to see.
#include <tessera/cpu-device.h>
#include <tessera/kernel-cache.h>
#include <tessera/probe.h>
#include <tessera/vulkan-device.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/support/machines.h"

using namespace tessera;
using namespace tessera::test;
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

  template <class Run>
  Probe probeWith(Device& device, Run run) const {
    KernelCache::Options options;
    options.slangSources = folder_;
    KernelCache kernels(options);
    return run(device, kernels);
  }
  Probe probe(Device& device, Route route) const {
    return probeWith(device, [&](Device& d, KernelCache& kernels) { return probeDevice(d, kernels, route); });
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
  CHECK(probe.results.size() == 29);
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

TEST_CASE("the probe finds that SwiftShader flushes denormals and nothing else") {
  if (Machine* swiftShader = machineAt<SwiftShader>())
    for (Route route : {Route::kSpirv, Route::kGlsl}) {
      const Probe probe = probeDevice(swiftShader->device(), swiftShader->kernels(), route);
      CHECK(failing(probe).size() == 2);
      CHECK(!probe.passed());
      CHECK(probe.onlyFlushes());
      CHECK_THAT(row(probe, "denormals").detail, Catch::Contains("should be 0x00000001"));
      CHECK(!row(probe, "int64").required);
      CHECK(row(probe, "two-word-to-float").passed);
    }
}

TEST_CASE("a probe that fails in more than denormals does not only flush") {
  Probe probe;
  probe.results = {{"denormals", true, false, ""}, {"loop-limit", false, false, ""}};
  CHECK(probe.onlyFlushes());
  probe.results.push_back({"divide", true, false, ""});
  CHECK(!probe.onlyFlushes());
  CHECK(!Probe{}.onlyFlushes());
}

PLACE_AND_SWIFTSHADER_TEST_CASE("64-bit integers have the bits of the host's as two words and native", "[wide]") {
  const Probe probe = probeWide(machine.device(), machine.kernels(), machine.route(), 1u << 20);
  CHECK(probe.passed());
  for (const auto& result : probe.results)
    if (result.required) CHECK(result.detail == "");
  CHECK(probe.results.size() == (machine.info().int64 ? 14 : 8));
}

TEST_CASE("the probe sees a division by way of the reciprocal") {
  const Altered sources("math/exact-math.slang", "return a / b;", "return a * (1.0f / b);");
  const auto device = makeCpuDevice();
  const Probe probe = sources.probe(*device, Route::kCpp);
  CHECK(!probe.passed());
  CHECK(!row(probe, "divide").passed);
  CHECK_THAT(row(probe, "divide").detail, Catch::StartsWith("a / b with a 0x"));
  CHECK(row(probe, "multiply").passed);
}

TEST_CASE("the probe sees a fused product and sum") {
  const Altered sources("stages/probe.slang", "a * b + c", "fma(a, b, c)");
  const auto device = makeCpuDevice();
  const Probe probe = sources.probe(*device, Route::kCpp);
  CHECK(!row(probe, "contraction").passed);
  CHECK(row(probe, "add").passed);
  CHECK(row(probe, "multiply").passed);
}

TEST_CASE("the probe sees denormals flushed to zero and does not blame the operation") {
  const Altered sources("stages/probe.slang", "asuint(a + b)",
                        "(asuint(a + b) & 0x7f800000u) == 0u ? asuint(a + b) & 0x80000000u : asuint(a + b)");
  const auto device = makeCpuDevice();
  const Probe probe = sources.probe(*device, Route::kCpp);
  CHECK(!row(probe, "denormals").passed);
  CHECK(row(probe, "add").passed);
}

TEST_CASE("the probe sees a wide integer rounded twice") {
  const Altered sources("axes/wide/native.slang", "return float(a);",
                        "return float(int(a >> 32)) * 4294967296.0f + float(uint(a));");
  const auto device = makeCpuDevice();
  const Probe probe = sources.probe(*device, Route::kCpp);
  CHECK(!row(probe, "int64-to-float").passed);
  CHECK(row(probe, "int64-product").passed);
  CHECK(row(probe, "two-word-to-float").passed);
}

TEST_CASE("the probe sees two words that lose a carry or a tie") {
  struct Fault {
    const char *from, *to, *row;
  };
  for (const auto& [from, to, name] :
       {Fault{"+ uint(low < a.low)", "", "two-word-add"},
        Fault{"((a0 * b1 + (t & 0xffff)) >> 16)", "((a0 * b1) >> 16)", "two-word-product"},
        Fault{"below + (mantissa & 1u) > 0x100u", "below >= 0x100u", "two-word-to-float"},
        Fault{"(a.high == b.high) & (a.low < b.low)", "(a.low < b.low)", "two-word-compare"}}) {
    INFO(from);
    const Altered sources("axes/wide/two-word.slang", from, to);
    const auto device = makeCpuDevice();
    const Probe probe = sources.probeWith(
        *device, [](Device& d, KernelCache& kernels) { return probeWide(d, kernels, Route::kCpp, 10000); });
    CHECK(!row(probe, name).passed);
    CHECK(row(probe, "int64-to-float").passed);
  }
}
