// Every stage under every value of every axis that it reads compiles on each route, and its SPIR-V keeps the contract.
#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>
#include <set>
#include <sstream>

#include "all-kernels.h"
#include "host/kernels/spirv.h"
#include "tests/support/streams.h"

using namespace tessera;
using namespace tessera::test;

namespace {

constexpr std::uint32_t kOpFAdd = 129, kOpFMul = 133, kOpDecorate = 71, kNoContraction = 42;

/// The place of the first instruction of this kind whose word `operand` is `value`.
std::size_t findInstruction(const std::vector<std::uint32_t>& words, std::uint32_t op, std::size_t operand = 0,
                            std::uint32_t value = 0) {
  for (std::size_t at = 5; at < words.size(); at += words[at] >> 16)
    if ((words[at] & 0xffff) == op && (operand == 0 || words[at + operand] == value)) return at;
  return words.size();
}

/// The kernel of `project`, which divides, multiplies and adds.
CompiledKernel projectKernel(Route route) {
  const plan::Stage& stage = *std::ranges::find(plan::stages(), "project", &plan::Stage::name);
  return KernelCache().get(kernelsOf(stage, route).at(0));
}

}  // namespace

/// Whether no plan dispatches the stage with this value.
bool neverRuns(const std::string& stage, const Axis& axis, const AxisValue& value, Route route) {
  if (value.needs.oneThreadGroups && route != Route::kCpp) return true;
  if (axis.name == "shade") return value.name == "none" || (stage == "payload" && value.name == "smooth");
  if (axis.name == "binning") return value.name == "none" || (stage == "bin-insert" && value.name == "aabb-scan");
  if (axis.name == "size-class") return stage == "raster-items" && value.name == "shape";
  if (axis.name != "commit") return false;
  return (stage == "raster-items" && commitTraits(value.name).writesTiles) ||
         (stage == "resolve" && !commitTraits(value.name).resolves) ||
         (stage == "payload" && !commitTraits(value.name).keepsColours);
}

TEST_CASE("every value of an axis that a stage reads is in a kernel of it") {
  for (const Route route : {Route::kCpp, Route::kSpirv, Route::kGlsl}) {
    for (const plan::Stage& stage : plan::stages()) {
      const std::vector<KernelRequest> pairs = kernelsOf(stage, route, 2);
      INFO(stage.name);
      REQUIRE(!pairs.empty());
      CHECK(kernelsOf(stage, route, 1).size() <= pairs.size());
      std::set<std::string> seen;
      for (const KernelRequest& kernel : pairs) {
        CHECK(kernel.route == route);
        for (const std::string& setting : settingsOf(kernel)) seen.insert(setting);
      }
      for (const Axis& axis : allAxes()) {
        if (!std::ranges::count(axis.stages, stage.name)) continue;
        for (const AxisValue& value : axis.values) {
          const std::string setting = axis.name + "=" + value.name;
          if (setting == "binning=queue" || setting == "binning=exact") continue;  // one kernel, under either name
          INFO(setting);
          CHECK(seen.contains(setting) == !neverRuns(stage.name, axis, value, route));
        }
      }
    }
  }
}

// Pairs of values compile to C++, and to SPIR-V whose exactness is checked there, too, for the random scenes of tests/parity; triples are
// behind the label long.
TEST_CASE("SPIR-V of Slang is exact and valid") {
  KernelCache cache;
  CHECK(findings(cache, coveringKernels(Route::kSpirv, 1)) == std::vector<std::string>{});
}

TEST_CASE("SPIR-V by way of GLSL is exact and valid") {
  KernelCache cache;
  CHECK(findings(cache, coveringKernels(Route::kGlsl, 1)) == std::vector<std::string>{});
}

TEST_CASE("a NoContraction that is missing is found on either route") {
  for (const Route route : {Route::kSpirv, Route::kGlsl}) {
    const CompiledKernel kernel = projectKernel(route);
    std::vector<std::uint32_t> words = kernels::readSpirv(kernel.binary);
    REQUIRE(kernels::checkSpirv(words).empty());
    REQUIRE(findInstruction(words, kOpFAdd) < words.size());
    REQUIRE(findInstruction(words, kOpFMul) < words.size());
    const std::size_t decoration = findInstruction(words, kOpDecorate, 2, kNoContraction);
    REQUIRE(decoration < words.size());
    words.erase(words.begin() + static_cast<std::ptrdiff_t>(decoration), words.begin() + static_cast<std::ptrdiff_t>(decoration) + 3);
    CHECK(kernels::checkSpirv(words).size() == 1);
  }
}

TEST_CASE("spirv-val finds what is no module") {
  std::vector<std::uint32_t> words = kernels::readSpirv(projectKernel(Route::kGlsl).binary);
  REQUIRE(spirvVal(words) == "");
  const std::size_t sum = findInstruction(words, kOpFAdd);
  REQUIRE(sum < words.size());
  words[sum + 3] = words[sum + 2];  // a sum of itself, before it is defined
  CHECK_THAT(spirvVal(words), Catch::StartsWith("spirv-val: "));
}
