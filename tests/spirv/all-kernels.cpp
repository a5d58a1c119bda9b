#include "all-kernels.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <glm/vec2.hpp>
#include <map>
#include <set>
#include <sstream>

#include "host/error.h"
#include "host/files.h"
#include "host/spirv.h"
#include "host/subprocess.h"
#include "host/vulkan/spirv-module.h"

namespace tessera::test {
namespace {

using Visit = std::function<void(const Variant&)>;

/// Every combination of the values of `names`.
void forEachVariant(const std::vector<std::string>& names, std::size_t at, Variant& chosen, const Visit& visit) {
  if (at == names.size()) return visit(chosen);
  for (const AxisValue& value : axis(names[at]).values) {
    chosen.set(names[at], value.name);
    forEachVariant(names, at + 1, chosen, visit);
  }
}

}  // namespace

Scene simpleScene(bool objectSpace) {
  Scene scene;
  scene.width = scene.height = 64;
  scene.triangles = {{0, 1, 2}};
  for (const glm::vec2 p : {glm::vec2(-0.5f, -0.5f), glm::vec2(-0.5f, 0.5f), glm::vec2(0.5f, -0.5f)}) {
    if (objectSpace) {
      scene.positions.emplace_back(p, 0.5f);
      scene.normals.emplace_back(0, 0, 1);
    } else {
      scene.clip.emplace_back(p, 0.5f, 1.0f);
    }
  }
  return scene;
}

std::vector<KernelRequest> kernelsOf(const Stage& stage, Route route) {
  DeviceInfo device;
  device.api = route == Route::kCpp ? "cpu" : "vulkan";
  Variant chosen;
  if (route == Route::kGlsl) chosen.set("route", "glsl");
  // What the stage reads makes its kernels; the others decide whether it runs at all.
  std::vector<std::string> names{"plan", "binning", "commit"};
  if (stage.name == "shade") names.push_back("shade");
  for (const Axis& a : axes())
    if (std::ranges::count(a.stages, stage.name) && !std::ranges::count(names, a.name)) names.push_back(a.name);

  std::map<std::string, KernelRequest> found;
  std::vector<std::string> order;
  for (const bool objectSpace : {true, false}) {
    Scene scene = simpleScene(objectSpace);
    if (stage.name == "attribute") scene.attribute.assign(scene.vertexCount(), 1.0f);
    forEachVariant(names, 0, chosen, [&](const Variant& variant) {
      try {
        const Plan plan = makePlan(scene, variant, device);
        if (!std::ranges::count(stagesOf(plan), stage.name)) return;
        KernelRequest request = kernelRequest(stage.name, plan);
        const std::string key = request.modules.text();
        if (found.emplace(key, std::move(request)).second) order.push_back(key);
      } catch (const Error&) {  // values that do not go together
      }
    });
  }
  std::vector<KernelRequest> kernels;
  for (const std::string& key : order) kernels.push_back(found.at(key));
  return kernels;
}

std::vector<std::string> settingsOf(const KernelRequest& kernel) {
  std::istringstream words(kernel.variantName);
  return {std::istream_iterator<std::string>(words), {}};
}

std::vector<KernelRequest> covering(const std::vector<KernelRequest>& kernels) {
  std::vector<KernelRequest> chosen;
  std::set<std::string> seen;
  for (const KernelRequest& kernel : kernels) {
    bool news = chosen.empty();
    for (const std::string& setting : settingsOf(kernel)) news |= seen.insert(setting).second;
    if (news) chosen.push_back(kernel);
  }
  return chosen;
}

std::vector<KernelRequest> coveringKernels(Route route) {
  std::vector<KernelRequest> all;
  for (const Stage& stage : stages()) std::ranges::copy(covering(kernelsOf(stage, route)), std::back_inserter(all));
  return all;
}

std::vector<KernelRequest> allKernels(Route route) {
  std::vector<KernelRequest> all;
  for (const Stage& stage : stages()) std::ranges::copy(kernelsOf(stage, route), std::back_inserter(all));
  return all;
}

std::string spirvVal(const std::vector<std::uint32_t>& words) {
  static const std::filesystem::path program = findProgram("spirv-val");
  if (program.empty()) fail("spirv-val is not installed: apt-get install spirv-tools");
  const TemporaryFolder folder(std::filesystem::temp_directory_path(), "tessera-spirv-val");
  const std::filesystem::path file = folder.path() / "module.spv";
  writeSpirv(file, words);
  const ProcessResult result = runProcess({program.string(), "--target-env", "vulkan1.2", file.string()});
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
    if (const std::string said = spirvVal(vulkan::readModule(compiled[i].binary).words); !said.empty()) report(said);
  }
  return lines;
}

}  // namespace tessera::test
