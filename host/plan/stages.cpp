#include "host/plan/stages.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tessera/error.h>

#include <algorithm>
#include <stdexcept>

#include "host/axes/routes.h"
#include "host/kernels/user-kernel.h"

namespace tessera {

const std::vector<Stage>& stages() {
  static const std::vector<Stage> list{
      {"clear", "rasterizer/clear.slang", "clear"},
      {"transform", "rasterizer/transform.slang", "transform"},
      {"project", "rasterizer/transform.slang", "project"},
      {"setup", "rasterizer/setup.slang", "setup"},
      {"payload", "rasterizer/payload.slang", "colourTriangles"},
      {"bin-count", "rasterizer/bin-count.slang", "binCount"},
      {"scan-blocks", "rasterizer/scan.slang", "scanBlocks"},
      {"scan-add", "rasterizer/scan.slang", "scanAdd"},
      {"bin-insert", "rasterizer/bin-insert.slang", "binInsert"},
      {"raster-tiles", "rasterizer/raster-tiles.slang", "rasterTiles"},
      {"raster-items", "rasterizer/raster-items.slang", "rasterItems"},
      {"resolve", "rasterizer/resolve.slang", "resolve"},
      {"shade", "rasterizer/shade.slang", "shade"},
      {"attribute", "rasterizer/attribute.slang", "interpolateAttribute"},
  };
  return list;
}

std::vector<std::string> stagesOf(const Plan& plan) {
  const Variant& v = plan.resolved;
  const std::string binning = v.get("binning");
  std::vector<std::string> names;
  if (plan.clear) names.push_back("clear");
  names.push_back(plan.transform ? "transform" : "project");
  names.push_back("setup");
  if (plan.payload) names.push_back("payload");
  if (binning == "exact") names.push_back("bin-count");
  if (binning == "exact" || (binning == "queue" && v.get("overflow") == "retry"))
    names.insert(names.end(), {"scan-blocks", "scan-add"});
  if (plan.binned && binning != "aabb-scan") names.push_back("bin-insert");
  names.push_back(plan.binned ? "raster-tiles" : "raster-items");
  if (plan.resolve) names.push_back("resolve");
  if (plan.shade) names.push_back("shade");
  if (plan.attribute) names.push_back("attribute");
  return names;
}

KernelRequest kernelRequest(std::string_view name, const Plan& plan) {
  const auto stage = std::ranges::find(stages(), name, &Stage::name);
  if (stage == stages().end()) throw std::logic_error("no stage " + std::string(name));
  KernelRequest request;
  request.stage = stage->name;
  request.source = stage->source;
  request.entry = stage->entry;
  request.route = routeNamed(plan.resolved.get("route")).route;
  request.modules = variantModules(name, plan.resolved);
  for (const Axis& axis : axes())
    if (std::ranges::find(axis.stages, name) != axis.stages.end())
      request.variantName += (request.variantName.empty() ? "" : " ") + axis.name + "=" + plan.resolved.get(axis.name);
  return request;
}

void checkStages(const Plan& plan, const KernelFiles& files) {
  const std::vector<std::string> names = stagesOf(plan);
  for (const auto& [stage, file] : files)
    if (std::ranges::find(names, stage) == names.end())
      failUsage(fmt::format("kernel {} ({}): this plan does not run such a stage; it runs {}", stage, file.string(),
                            fmt::join(names, ", ")));
}

std::vector<KernelRequest> kernelRequests(const Plan& plan, const KernelFiles& files) {
  checkStages(plan, files);
  std::vector<KernelRequest> requests;
  for (const std::string& name : stagesOf(plan)) {
    const auto file = files.find(name);
    KernelRequest own = kernelRequest(name, plan);
    requests.push_back(file == files.end() ? std::move(own) : requestOf(std::move(own), file->second));
  }
  return requests;
}

std::vector<CompiledKernel> compileStages(KernelCache& cache, const Plan& plan) {
  std::vector<CompiledKernel> kernels = cache.getAll(kernelRequests(plan, cache.files()));
  if (cache.files().empty()) return kernels;
  const std::vector<CompiledKernel> own = cache.getAll(kernelRequests(plan, {}));
  KernelInterface all;  // the buffers and uniforms that there are
  for (const CompiledKernel& kernel : own) {
    all.elementSizes.insert(kernel.interface.elementSizes.begin(), kernel.interface.elementSizes.end());
    all.fields.insert(kernel.interface.fields.begin(), kernel.interface.fields.end());
  }
  for (std::size_t i = 0; i < kernels.size(); ++i)
    if (!kernels[i].file.empty()) checkInterface(kernels[i], own[i].interface, all);
  return kernels;
}

}  // namespace tessera
