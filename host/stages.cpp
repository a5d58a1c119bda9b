#include "host/stages.h"

#include <algorithm>
#include <stdexcept>

namespace tessera {

const std::vector<Stage>& stages() {
  static const std::vector<Stage> list{
      {"clear", "rasterizer/clear.slang", "clearVisibility"},
      {"clear-packed", "rasterizer/clear.slang", "clearPacked"},
      {"transform", "rasterizer/transform.slang", "transform"},
      {"project", "rasterizer/transform.slang", "project"},
      {"setup", "rasterizer/setup.slang", "setup"},
      {"bin-count", "rasterizer/bin.slang", "binCount"},
      {"scan-blocks", "rasterizer/scan.slang", "scanBlocks"},
      {"scan-add", "rasterizer/scan.slang", "scanAdd"},
      {"bin-insert", "rasterizer/bin.slang", "binInsert"},
      {"raster-tiles", "rasterizer/raster-tiles.slang", "rasterTiles"},
      {"raster-items", "rasterizer/raster-items.slang", "rasterItems"},
      {"resolve", "rasterizer/resolve.slang", "resolve"},
      {"shade", "rasterizer/shade.slang", "shade"},
  };
  return list;
}

std::vector<std::string> stagesOf(const Plan& plan) {
  const Variant& v = plan.resolved;
  const std::string commit = v.get("commit"), binning = v.get("binning");
  std::vector<std::string> names;
  if (plan.clear && commit != "count") names.push_back(commit == "depth32+id32" ? "clear-packed" : "clear");
  names.push_back(plan.transform ? "transform" : "project");
  names.push_back("setup");
  if (binning == "exact") names.push_back("bin-count");
  if (binning == "exact" || (binning == "queue" && v.get("overflow") == "retry"))
    names.insert(names.end(), {"scan-blocks", "scan-add"});
  if (binning == "none")
    names.push_back("raster-items");
  else
    names.insert(names.end(), {"bin-insert", "raster-tiles"});
  if (commit == "depth32+id32") names.push_back("resolve");
  if (plan.shade) names.push_back("shade");
  return names;
}

KernelRequest kernelRequest(std::string_view name, const Plan& plan) {
  const auto stage = std::ranges::find(stages(), name, &Stage::name);
  if (stage == stages().end()) throw std::logic_error("no stage " + std::string(name));
  const std::string route = plan.resolved.get("route");
  KernelRequest request;
  request.stage = stage->name;
  request.source = stage->source;
  request.entry = stage->entry;
  request.route = route == "cpp" ? Route::kCpp : route == "glsl" ? Route::kGlsl : Route::kSpirv;
  request.modules = variantModules(name, plan.resolved);
  for (const Axis& axis : axes())
    if (std::ranges::find(axis.stages, name) != axis.stages.end())
      request.variantName += (request.variantName.empty() ? "" : " ") + axis.name + "=" + plan.resolved.get(axis.name);
  return request;
}

}  // namespace tessera
