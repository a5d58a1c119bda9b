// Each value of each axis is seen at work: it has kernels of its own, or another way through the host, and a counter or
// an image shows it.
#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "evidence.h"
#include "host/kernel-cache.h"
#include "host/slang-sources.h"
#include "host/spirv.h"
#include "host/stages.h"

using namespace tessera;

namespace {

/// The module without names and other text for people, so that only what it does is left (SPIR-V 1.6, sections 3.42.2
/// and 3.42.3).
std::vector<std::uint32_t> stripped(std::vector<std::uint32_t> module) {
  const std::set<std::uint32_t> debug{2, 3, 4, 5, 6, 7, 8, 317, 330};
  std::vector<std::uint32_t> words(module.begin(), module.begin() + 5);
  for (std::size_t at = 5; at < module.size(); at += module[at] >> 16)
    if (!debug.contains(module[at] & 0xffff))
      words.insert(words.end(), module.begin() + static_cast<std::ptrdiff_t>(at),
                   module.begin() + static_cast<std::ptrdiff_t>(at + (module[at] >> 16)));
  return words;
}

/// A full plan, so that each stage has in it all that an axis could change; then `axis` as given, without asking
/// whether the planner would.
Plan planWith(const std::string& axis, const std::string& value) {
  DeviceInfo device;
  device.api = "vulkan";
  Plan plan = makePlan(Scene{}, {{"plan", "full"}}, device);
  plan.resolved.set(axis, value);
  return plan;
}

std::vector<std::string> valueNames(const Axis& axis) {
  std::vector<std::string> names;
  for (const AxisValue& value : axis.values) names.push_back(value.name);
  return axis.values.empty() ? std::vector<std::string>{"least", "most"} : names;
}

}  // namespace

TEST_CASE("Each axis value is seen at work", "[axes]") {
  for (const Axis& axis : axes())
    for (const std::string& value : valueNames(axis)) {
      INFO(axis.name << "=" << value);
      evidence(axis.name, value)();
    }
}

TEST_CASE("Each value of an axis that kernels read has kernels of its own", "[axes]") {
  KernelCache cache;
  for (const Axis& axis : axes()) {
    for (const std::string& stage : axis.stages) {
      std::map<std::vector<std::uint32_t>, std::string> seen;
      for (const AxisValue& value : axis.values) {
        // Left out, not compiled: these pairs never run.
        if (stage == "shade" && value.name == "none") continue;
        if (stage == "raster-items" && value.name == "tile-owned") continue;
        Plan plan = planWith(axis.name, value.name);
        if (stage == "raster-items" && axis.name != "commit") plan.resolved.set("commit", "depth32+id32");
        if (stage == "shade" && axis.name != "shade") plan.resolved.set("shade", "flat");
        INFO(stage << ", " << axis.name << "=" << value.name);
        const auto [other, isNew] =
            seen.try_emplace(stripped(readSpirv(cache.get(kernelRequest(stage, plan)).binary)), value.name);
        INFO("the same kernel as " << other->second);
        CHECK(isNew);
      }
    }
    // Else the host reads it: evidence.cpp shows what that does.
    if (axis.stages.empty())
      for (const AxisValue& value : axis.values) CHECK(value.slang == "");
  }
}

TEST_CASE("Each route has kernels of its own", "[axes]") {
  KernelCache cache;
  for (const Stage& stage : stages()) {
    std::set<std::string> binaries;
    for (const AxisValue& route : axis("route").values) {
      Plan plan = planWith("route", route.name);
      plan.resolved.set("commit", "two-pass");
      plan.resolved.set("shade", "flat");
      binaries.insert(readText(cache.get(kernelRequest(stage.name, plan)).binary));
    }
    INFO(stage.name);
    CHECK(binaries.size() == axis("route").values.size());
  }
}

TEST_CASE("A stage's kernel is keyed by the axes that it reads alone", "[axes]") {
  for (const Axis& axis : axes())
    for (const Stage& stage : stages()) {
      std::set<std::string> modules;
      for (const AxisValue& value : axis.values)
        modules.insert(kernelRequest(stage.name, planWith(axis.name, value.name)).modules.text());
      INFO(stage.name << ", " << axis.name);
      const bool read = std::ranges::find(axis.stages, stage.name) != axis.stages.end();
      CHECK(modules.size() == (read ? axis.values.size() : std::size_t{!axis.values.empty()}));
    }
}
