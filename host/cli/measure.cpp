#include "host/cli/measure.h"

#include <set>
#include <tuple>

#include "host/cli/progress.h"
#include "host/stages.h"

namespace tessera::cli {

void compileKernels(KernelCache& kernels, const std::vector<Plan>& plans) {
  std::vector<KernelRequest> requests;
  std::set<std::tuple<std::string, Route, VariantModules>> seen;
  for (const auto& plan : plans)
    for (const auto& stage : stagesOf(plan)) {
      KernelRequest request = kernelRequest(stage, plan);
      if (seen.emplace(request.stage, request.route, request.modules).second)
        requests.push_back(std::move(request));
    }
  Progress progress("compiling kernels", requests.size());
  kernels.getAll(requests, [&](std::size_t done, std::size_t) { progress.at(done); });
}

Run beginRun(const Scene& scene, const Variant& variant, const Device& device, const KernelCache& kernels) {
  Run run;
  run.scene = &scene;
  run.variant = variant;
  run.device = device.info();
  run.slang = kernels.slangc().version;
  run.kernelCompiler = kernels.cxx();
  return run;
}

Frame measure(Run& run, Rasterizer& rasterizer, KernelCache& kernels, unsigned repeat,
              const std::function<void(unsigned)>& progress) {
  const Variant asked = run.variant;
  Frame first = rasterizer.render(*run.scene, asked);
  run.variant = first.plan.resolved;
  run.plan = first.plan.entries;
  run.counters = first.counters;
  for (const auto& stage : stagesOf(first.plan))
    run.kernels[stage] = kernels.get(kernelRequest(stage, first.plan)).hash;
  for (unsigned i = 0; i < repeat; ++i) {
    if (progress) progress(i + 1);
    run.samples.push_back(rasterizer.render(*run.scene, asked, {.readBack = false}).times);
  }
  return first;
}

std::string frameLabel(const Run& run) {
  return run.variant.get("shade", "none") == "none" ? "frame" : "frame without shade";
}

}  // namespace tessera::cli
