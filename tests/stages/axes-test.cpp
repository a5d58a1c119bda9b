// Each value of each axis is seen at work: it has kernels of its own, or another way through the host, and a counter or
// an image shows it.
#include <tessera/error.h>
#include <tessera/kernel-cache.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <optional>
#include <set>

#include "evidence.h"
#include "host/kernels/slang-sources.h"
#include "host/kernels/spirv.h"
#include "host/plan/stages.h"
#include "tests/support/streams.h"

using namespace tessera;
using namespace tessera::test;

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

/// One triangle in object space, with a value for the attribute stage.
Scene triangleScene() {
  Scene scene;
  scene.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  scene.triangles = {{0, 1, 2}};
  setNormals(scene, {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}});
  attributeOf(scene) = {1, 2, 3};
  return scene;
}

/// Settings under which a stage runs and has in it all that an axis could change.
Variant settingFor(const std::string& stage) {
  if (stage == "raster-items") return {{"binning", "none"}};
  if (stage == "payload") return {{"commit", "depth24+lum8"}};
  if (stage == "resolve") return {{"commit", "depth32+id32"}};
  if (stage == "shade") return {{"shade", "flat"}};
  if (stage == "attribute") return {};
  return {{"plan", "full"}, {"binning", "exact"}};
}

/// The plan with `axis` as given on top; nothing where it is refused or leaves the stage out.
std::optional<Plan> planWith(const std::string& stage, const std::string& axis, const std::string& value) {
  DeviceInfo device;
  const bool cpu = value == "cpp" || value == "lock";  // those two are for the CPU device
  device.routes = cpu ? std::vector<std::string>{"cpp"} : std::vector<std::string>{"spirv", "glsl"};
  Variant variant = settingFor(stage);
  variant.set(axis, value);
  Scene scene = triangleScene();
  if (stage != "attribute") dropAttribute(scene);
  if (stage == "project") {
    scene.clip.assign(3, {0, 0, 0, 1});
    scene.positions.clear();
    dropNormals(scene);
  }
  try {
    Plan plan = makePlan(scene, variant, device);
    const std::vector<std::string> dispatched = plan.stages;
    if (std::ranges::find(dispatched, stage) != dispatched.end()) return plan;
  } catch (const Error&) {
  }
  return std::nullopt;
}

std::vector<std::string> valueNames(const Axis& axis) {
  std::vector<std::string> names;
  for (const AxisValue& value : axis.values) names.push_back(value.name);
  return axis.values.empty() ? std::vector<std::string>{"least", "most"} : names;
}

}  // namespace

TEST_CASE("Each axis value is seen at work", "[axes]") {
  for (const Axis& axis : allAxes())
    for (const std::string& value : valueNames(axis)) {
      INFO(axis.name << "=" << value);
      evidence(axis.name, value)();
    }
}

TEST_CASE("Each value of an axis that kernels read has kernels of its own", "[axes]") {
  KernelCache cache;
  for (const Axis& axis : allAxes()) {
    std::map<std::string, std::map<std::string, std::vector<std::uint32_t>>> kernels;  // by value, by stage
    for (const std::string& stage : axis.stages)
      for (const AxisValue& value : axis.values)
        if (const auto plan = planWith(stage, axis.name, value.name); plan && plan->resolved.get("route") == "spirv")
          kernels[value.name][stage] =
              stripped(kernels::readSpirv(cache.get(plan::kernelRequest(stage, *plan)).binary));
    for (const AxisValue& a : axis.values)
      for (const AxisValue& b : axis.values) {
        if (a.slang == b.slang) continue;  // the host does it: evidence.cpp shows what
        if (!kernels.contains(a.name) || !kernels.contains(b.name)) continue;  // one of them runs no such stage
        INFO(axis.name << "=" << a.name << " and " << b.name << " have the same kernels");
        CHECK(std::ranges::any_of(axis.stages, [&](const std::string& stage) {
          const auto &of = kernels[a.name], &other = kernels[b.name];
          return of.contains(stage) && other.contains(stage) && of.at(stage) != other.at(stage);
        }));
      }
    if (axis.stages.empty())
      for (const AxisValue& value : axis.values) CHECK(value.slang == "");
  }
}

TEST_CASE("Each route has kernels of its own", "[axes]") {
  KernelCache cache;
  for (const plan::Stage& stage : plan::stages()) {
    INFO(stage.name);
    std::set<std::string> binaries;
    for (const AxisValue& route : axis("route").values) {
      const auto plan = planWith(stage.name, "route", route.name);
      REQUIRE(plan);
      binaries.insert(kernels::readText(cache.get(plan::kernelRequest(stage.name, *plan)).binary));
    }
    CHECK(binaries.size() == axis("route").values.size());
  }
}

TEST_CASE("A stage's kernel is keyed by the axes that it reads alone", "[axes]") {
  for (const plan::Stage& stage : plan::stages()) {
    const auto base = planWith(stage.name, "route", "spirv");
    REQUIRE(base);
    for (const Axis& axis : allAxes()) {
      std::set<std::string> modules, texts;
      for (const AxisValue& value : axis.values) {
        Plan plan = *base;  // as given, without asking whether the planner would
        plan.resolved.set(axis.name, value.name);
        modules.insert(plan::kernelRequest(stage.name, plan).modules.text());
        texts.insert(value.slang);
      }
      INFO(stage.name << ", " << axis.name);
      const bool read = std::ranges::find(axis.stages, stage.name) != axis.stages.end();
      CHECK(modules.size() == (read ? texts.size() : std::size_t{!axis.values.empty()}));
    }
  }
}
