#include "all-kernels.h"

#include <fmt/format.h>
#include <tessera/error.h>

#include <algorithm>
#include <glm/vec2.hpp>
#include <iterator>
#include <optional>
#include <set>

#include "host/axes/routes.h"
#include "host/axes/settings.h"
#include "host/devices/vulkan/spirv-module.h"
#include "host/kernels/spirv-bounds.h"
#include "host/kernels/spirv.h"
#include "host/support/files.h"
#include "host/support/subprocess.h"
#include "tests/support/covering.h"
#include "tests/support/streams.h"

namespace tessera::test {
namespace {

/// What a stage needs to be dispatched at all, beside the axes that it reads.
Variant settingFor(const std::string& stage) {
  Variant setting{{"plan", "full"}};
  if (stage == "raster-items") setting.set("binning", "none");
  if (stage == "bin-count" || stage.starts_with("scan")) setting.set("binning", "exact");
  return setting;
}

}  // namespace

Scene simpleScene(bool objectSpace) {
  Scene scene;
  scene.width = scene.height = 64;
  scene.triangles = {{0, 1, 2}};
  if (objectSpace) setNormals(scene, std::vector<glm::vec3>(3, {0, 0, 1}));
  for (const glm::vec2 p : {glm::vec2(-0.5f, -0.5f), glm::vec2(-0.5f, 0.5f), glm::vec2(0.5f, -0.5f)}) {
    if (objectSpace)
      scene.positions.emplace_back(p, 0.5f);
    else
      scene.clip.emplace_back(p, 0.5f, 1.0f);
  }
  return scene;
}

std::vector<KernelRequest> kernelsOf(const plan::Stage& stage, Route route, std::size_t strength) {
  DeviceInfo device;
  device.routes = {axes::routeInfo(route).name};
  Scene scene = simpleScene(stage.name != "project");
  if (stage.name == "attribute") attributeOf(scene).assign(scene.vertexCount(), 1.0f);
  Variant base = settingFor(stage.name);
  std::vector<AxisValues> axesRead;
  for (const Axis& a : allAxes())
    if (std::ranges::count(a.stages, stage.name) && !base.has(a.name)) {
      axesRead.emplace_back(a.name, std::vector<std::string>{});
      for (const AxisValue& value : a.values) axesRead.back().second.push_back(value.name);
    }
  const auto planOf = [&](const Variant& variant) -> std::optional<Plan> {
    try {
      Plan plan = makePlan(scene, variant, device);
      if (plan.runs(stage.name)) return plan;
    } catch (const Error&) {  // values that do not go together
    }
    return std::nullopt;
  };
  std::vector<KernelRequest> kernels;
  std::set<VariantModules> seen;
  for (const Variant& variant :
       covering(base, axesRead, strength, [&](const Variant& v) { return planOf(v).has_value(); })) {
    KernelRequest request = plan::kernelRequest(stage.name, *planOf(variant));
    if (seen.insert(request.modules).second) kernels.push_back(std::move(request));
  }
  return kernels;
}

std::vector<std::string> settingsOf(const KernelRequest& kernel) { return axes::settingsIn(kernel.variantName); }

std::vector<KernelRequest> coveringKernels(Route route, std::size_t strength) {
  std::vector<KernelRequest> all;
  for (const plan::Stage& stage : plan::stages())
    std::ranges::copy(kernelsOf(stage, route, strength), std::back_inserter(all));
  return all;
}

std::string spirvVal(const std::vector<std::uint32_t>& words) {
  static const std::filesystem::path program = support::findProgram("spirv-val");
  if (program.empty()) fail("spirv-val is not installed: apt-get install spirv-tools");
  const support::TemporaryFolder folder(std::filesystem::temp_directory_path(), "tessera-spirv-val");
  const std::filesystem::path file = folder.path() / "module.spv";
  kernels::writeSpirv(file, words);
  const support::ProcessResult result =
      support::runProcess({program.string(), "--target-env", "vulkan1.2", file.string()});
  return result.ok() ? "" : "spirv-val: " + result.output;
}

std::vector<std::string> findings(KernelCache& cache, const std::vector<KernelRequest>& kernels) {
  const std::vector<CompiledKernel> compiled = cache.getAll(kernels);
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < compiled.size(); ++i) {
    const auto report = [&](const std::string& what) {
      lines.push_back(fmt::format("{} [{}]: {}", kernels[i].stage, kernels[i].variantName, what));
    };
    for (const std::string& violation : checkSpirv(compiled[i].binary)) report(violation);
    // Without OpSource, whose language number for Slang Debian 12's spirv-val does not know.
    const std::vector<std::uint32_t> words = devices::vulkan::readModule(compiled[i].binary).words;
    if (const std::string said = spirvVal(words); !said.empty()) report(said);
    const std::vector<std::uint32_t> checked = kernels::addBoundsChecks(words, compiled[i].interface.resources).words;
    if (const std::string said = spirvVal(checked); !said.empty()) report("with bounds checks: " + said);
    for (const std::string& violation : kernels::checkSpirv(checked)) report("with bounds checks: " + violation);
  }
  return lines;
}

}  // namespace tessera::test
