// The stages of the pipeline and the kernels that run them.
#pragma once

#include <tessera/kernel-cache.h>
#include <tessera/plan.h>

#include <string>
#include <string_view>
#include <vector>

namespace tessera {

struct Stage {
  std::string name;    ///< as in Axis::stages, in plans, times and messages
  std::string source;  ///< under slang/
  std::string entry;
};

/// All stages, in pipeline order.
const std::vector<Stage>& stages();
/// The stages that a plan dispatches, retries among them.
std::vector<std::string> stagesOf(const Plan& plan);
/// Throws kUsage for a file of a stage that the plan does not dispatch.
void checkStages(const Plan& plan, const KernelFiles& files);
/// What to compile for one stage of a plan: its own kernel.
KernelRequest kernelRequest(std::string_view stage, const Plan& plan);
/// The same for all of stagesOf(plan), a user's files in place of their stages' own kernels. Throws as
/// checkStages() and requestOf() of user-kernel.h do.
std::vector<KernelRequest> kernelRequests(const Plan& plan, const KernelFiles& files);
/// Compiles them, with the cache's files, and checks that the host can bind what the user brought.
std::vector<CompiledKernel> compileStages(KernelCache& cache, const Plan& plan);

}  // namespace tessera
