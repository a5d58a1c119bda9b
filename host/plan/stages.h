// THE list of stages: when each one runs, over what, and why a plan keeps it or leaves it out. The plan, the kernels to
// compile, the frame and the command line derive from it.
#pragma once

#include <tessera/kernel-cache.h>
#include <tessera/plan.h>
#include <tessera/scene.h>

#include <string>
#include <string_view>
#include <vector>

#include "host/plan/extent.h"
#include "host/plan/settings.h"

namespace tessera {

/// What decides which stages a plan runs. Everything in it is chosen before the first stage is looked at.
struct PlanFacts {
  const Scene& scene;
  const Settings& settings;
  bool full;                           ///< plan=full
  bool crosses;                        ///< a triangle may cross a clip plane
  bool orthographic;                   ///< w is 1 at every vertex
  bool byTiles;                        ///< see BinsPlan
  std::vector<std::string> binStages;  ///< see BinsPlan
  std::string whyUncounted;            ///< see BinsPlan
};

/// The moments of a frame, in their order. At each of them the frame runs the plan's stages of the moment, as they
/// stand in the list; stages of kDriven are dispatched by the host's part for them: host/frame/setup, bins and raster.
enum class Moment {
  kBand,     ///< before the first batch of a band
  kBatch,    ///< after setup of a batch, before its bins
  kDriven,   ///< setup, bins and raster of a batch
  kRaster,   ///< after the raster of the band's last batch
  kVisible,  ///< with the finished visibility buffer, once for each batch
  kStreams,  ///< the same, and once for each stream that is interpolated
};

/// Whether a plan runs a stage, and what it says about it: an entry for the stage, and one for each switch in it.
struct Need {
  bool runs;
  std::vector<PlanEntry> entries;
};

struct Stage {
  std::string name;    ///< as in Axis::stages, in plans, times and messages
  std::string source;  ///< under slang/
  std::string entry;   ///< entry point
  Moment moment;
  Extent over;  ///< what there is a lane for, or a group
  bool groups;  ///< whether there is a group for each; else a lane
  Need (*need)(const PlanFacts& facts);
};

/// All stages, in pipeline order.
const std::vector<Stage>& stages();
/// Throws kFailure with the name where no stage has it.
const Stage& stageOf(std::string_view name);
/// Whether the stage comes after the visibility buffer: a frame's time is without it.
bool isBehindVisibility(std::string_view stage);
/// Number of groups of a dispatch as a formula over fields of its uniform block, e.g. "ceil(vertexCount / 64)".
std::string groupFormula(const Stage& stage);
std::uint64_t groupsOf(const Stage& stage, const UniformValue& uniform);

/// Throws kUsage for a file of a stage that the plan does not dispatch.
void checkStages(const Plan& plan, const KernelFiles& files);
/// What to compile for one stage of a plan: its own kernel.
KernelRequest kernelRequest(std::string_view stage, const Plan& plan);
/// The same for all of Plan::stages, a user's files in place of their stages' own kernels. Throws as
/// checkStages() and requestOf() of user-kernel.h do.
std::vector<KernelRequest> kernelRequests(const Plan& plan, const KernelFiles& files);
/// Compiles them, with the cache's files, and checks that the host can bind what the user brought.
std::vector<CompiledKernel> compileStages(KernelCache& cache, const Plan& plan);

}  // namespace tessera
