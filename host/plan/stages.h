// THE list of stages: when a stage runs, over what, and why a plan keeps the stage or leaves it out. The plan, the
// kernels to compile, the frame and the command line derive from this list.
#pragma once

#include <tessera/kernel-cache.h>
#include <tessera/plan.h>
#include <tessera/scene.h>

#include <string>
#include <string_view>
#include <vector>

#include "host/plan/extent.h"
#include "host/plan/settings.h"

namespace tessera::plan {

/// The facts that decide which stages a plan runs. All of them are known before the plan looks at the first stage.
struct PlanFacts {
  const Scene& scene;
  const Settings& settings;
  bool full;                           ///< whether plan=full is set
  bool crosses;                        ///< whether a triangle may cross a clip plane
  bool orthographic;                   ///< whether w is 1 at every vertex
  bool byTiles;                        ///< see BinsPlan::byTiles()
  std::vector<std::string> binStages;  ///< see BinsPlan::stages()
  std::string whyUncounted;            ///< see BinsPlan::whyUncounted()
};

/// The moments of a frame, in their order. At each moment the frame runs the plan's stages of this moment, in the order
/// of the list. The stages of kDriven are different: the host's part for them (host/frame/setup, bins and raster)
/// dispatches them.
enum class Moment {
  kBand,     ///< before the first batch of a band
  kBatch,    ///< after setup of a batch, before its bins
  kDriven,   ///< setup, bins and raster of a batch
  kRaster,   ///< after the raster of the band's last batch
  kVisible,  ///< after the visibility buffer is finished, once for each batch
  kStreams,  ///< after kVisible, once for each batch and each stream that is interpolated
};

/// Whether a plan runs a stage, and what the plan says about the stage: an entry for the stage, and an entry for each
/// switch in the stage.
struct Need {
  bool runs;
  std::vector<PlanEntry> entries;
};

/// One stage of the pipeline.
struct Stage {
  std::string name;                      ///< the name in Axis::stages, plans, times and messages
  std::string source;                    ///< path of the kernel's file, under slang/
  std::string entry;                     ///< the kernel's entry point
  Moment moment;                         ///< when the stage runs
  Extent over;                           ///< what the stage runs over
  bool groups;                           ///< whether each element of `over` has a group; otherwise it has a lane
  Need (*need)(const PlanFacts& facts);  ///< whether a plan runs the stage
};

/// All stages, in pipeline order.
const std::vector<Stage>& stages();
/// The stage `name`. Throws kFailure with the name where no stage has it.
const Stage& stageOf(std::string_view name);
/// Whether the stage comes after the visibility buffer. The time of a frame does not include such a stage.
bool isBehindVisibility(std::string_view stage);
/// The number of groups of a dispatch as a formula over fields of its uniform block, e.g. "ceil(vertexCount / 64)".
std::string groupFormula(const Stage& stage);
/// The number of groups of a dispatch while the uniforms have these values.
std::uint64_t groupsOf(const Stage& stage, const UniformValue& uniform);

/// Throws kUsage where a file is for a stage that the plan does not dispatch.
void checkStages(const Plan& plan, const KernelFiles& files);
/// The request to compile one stage's own kernel for a plan.
KernelRequest kernelRequest(std::string_view stage, const Plan& plan);
/// The requests for all of Plan::stages. A user's file takes the place of its stage's own kernel. Throws as
/// checkStages() does, and as requestOf() of user-kernel.h does.
std::vector<KernelRequest> kernelRequests(const Plan& plan, const KernelFiles& files);
/// Compiles the kernels of all of Plan::stages, with the cache's files, and checks that the host can bind the user's
/// kernels.
std::vector<CompiledKernel> compileStages(KernelCache& cache, const Plan& plan);

}  // namespace tessera::plan
