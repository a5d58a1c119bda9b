#include "host/plan/stages.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tessera/error.h>

#include <algorithm>

#include "host/axes/routes.h"
#include "host/kernels/user-kernel.h"
#include "host/plan/needs.h"
#include "host/support/suggest.h"

namespace tessera::plan {
namespace {

constexpr std::uint32_t kLanes = 64;  // slang's workgroup has the same
constexpr bool kGroupEach = true, kLaneEach = false;

}  // namespace

const std::vector<Stage>& stages() {
  using enum Moment;
  using enum Extent;
  static const std::vector<Stage> list{
      {"clear", "stages/clear.slang", "clear", kBand, kPixels, kLaneEach, needClear},
      {"transform", "stages/transform.slang", "transform", kBand, kVertices, kLaneEach, needTransform},
      {"project", "stages/transform.slang", "project", kBand, kVertices, kLaneEach, needProject},
      {"setup", "stages/setup.slang", "setup", kDriven, kTriangles, kLaneEach, needSetup},
      {"payload", "stages/payload.slang", "colourTriangles", kBatch, kTriangles, kLaneEach, needPayload},
      {"bin-count", "stages/bin-count.slang", "binCount", kDriven, kWorkItems, kLaneEach, needBinCount},
      {"scan-blocks", "stages/prefix-sum.slang", "scanBlocks", kDriven, kScanGroups, kGroupEach, needScanBlocks},
      {"scan-add", "stages/prefix-sum.slang", "scanAdd", kDriven, kScanGroups, kGroupEach, needScanAdd},
      {"bin-insert", "stages/bin-insert.slang", "binInsert", kDriven, kWorkItems, kLaneEach, needBinInsert},
      {"raster-tiles", "stages/raster-tiles.slang", "rasterTiles", kDriven, kTiles, kGroupEach, needRasterTiles},
      {"raster-items", "stages/raster-items.slang", "rasterItems", kDriven, kWorkItems, kLaneEach, needRasterItems},
      {"resolve", "stages/resolve.slang", "resolve", kRaster, kPixels, kLaneEach, needResolve},
      {"shade", "stages/shade.slang", "shade", kVisible, kPixels, kLaneEach, needShade},
      {"attribute", "stages/attribute.slang", "interpolateAttribute", kStreams, kPixels, kLaneEach, needAttribute},
  };
  return list;
}

const Stage& stageOf(std::string_view name) {
  const auto found = std::ranges::find(stages(), name, &Stage::name);
  if (found != stages().end()) return *found;
  fail(fmt::format("no stage is called `{}`; {}", name,
                   support::whatThereIs(name, support::namesOf(stages(), &Stage::name))));
}

bool isBehindVisibility(std::string_view stage) { return stageOf(stage).moment >= Moment::kVisible; }

std::string groupFormula(const Stage& stage) {
  return stage.groups ? formula(stage.over) : fmt::format("ceil({} / {})", formula(stage.over), kLanes);
}

std::uint64_t groupsOf(const Stage& stage, const UniformValue& uniform) {
  const std::uint64_t elements = count(stage.over, uniform);
  return stage.groups ? elements : ceilDivide(elements, kLanes);
}

KernelRequest kernelRequest(std::string_view name, const Plan& plan) {
  const Stage& stage = stageOf(name);
  KernelRequest request;
  request.stage = stage.name;
  request.source = stage.source;
  request.entry = stage.entry;
  request.route = axes::routeNamed(plan.resolved.get("route")).route;
  request.modules = variantModules(name, plan.resolved);
  for (const Axis& axis : allAxes())
    if (std::ranges::find(axis.stages, name) != axis.stages.end())
      request.variantName += (request.variantName.empty() ? "" : " ") + axis.name + "=" + plan.resolved.get(axis.name);
  return request;
}

void checkStages(const Plan& plan, const KernelFiles& files) {
  for (const auto& [stage, file] : files)
    if (!plan.runs(stage))
      failUsage(fmt::format("kernel {} ({}): this plan does not run such a stage; it runs {}", stage, file.string(),
                            fmt::join(plan.stages, ", ")));
}

std::vector<KernelRequest> kernelRequests(const Plan& plan, const KernelFiles& files) {
  checkStages(plan, files);
  std::vector<KernelRequest> requests;
  for (const std::string& name : plan.stages) {
    const auto file = files.find(name);
    KernelRequest own = kernelRequest(name, plan);
    requests.push_back(file == files.end() ? std::move(own) : kernels::requestOf(std::move(own), file->second));
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
  for (const std::string& stream : plan.streams) all.elementSizes.emplace(stream, sizeof(float));
  for (std::size_t i = 0; i < kernels.size(); ++i)
    if (!kernels[i].file.empty()) kernels::checkInterface(kernels[i], own[i].interface, all);
  return kernels;
}

}  // namespace tessera::plan
