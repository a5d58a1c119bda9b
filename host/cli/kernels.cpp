// tessera kernels: compiles ahead what rendering would compile at first use.
#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <memory>

#include "datasets/input.h"
#include "host/cli/commands.h"
#include "host/cli/common.h"
#include "host/cli/measure.h"
#include "host/kernel-cache.h"
#include "host/plan.h"

namespace tessera::cli {
namespace {

struct KernelsOptions : Options {
  bool prebuild = false;
};

/// What the plan chooses where nothing is set: in perspective and without, with clipping and without, shaded and not.
std::vector<Plan> defaultPlans(const DeviceInfo& device) {
  std::vector<Plan> plans;
  for (const char* const input : {"generate:icosphere?level=1", "generate:grid"}) {
    const Scene scene = loadInput(input);
    for (const char* const shade : {"none", "flat", "smooth"}) {
      plans.push_back(makePlan(scene, {{"shade", shade}}, device));
      plans.push_back(makePlan(scene, {{"shade", shade}, {"clip", "on"}}, device));
    }
  }
  return plans;
}

ExitCode runKernels(const KernelsOptions& options) {
  std::vector<Plan> plans;
  for (const auto& name : options.devices.empty() ? presentDevices() : options.devices) {
    const auto device = openDevice(name, 0);
    for (auto& plan : defaultPlans(device->info())) plans.push_back(std::move(plan));
  }
  KernelCache kernels;
  compileKernels(kernels, plans);
  const KernelCache::Statistics statistics = kernels.statistics();
  fmt::print("{} kernels of the default variants are ready in {}, {} of them compiled now\n",
             statistics.hits + statistics.compiled, kernels.folder().string(), statistics.compiled);
  return ExitCode::kDone;
}

}  // namespace

Command addKernels(CLI::App& app) {
  auto options = std::make_shared<KernelsOptions>();
  auto* const command = app.add_subcommand("kernels", "compile kernels ahead of their first use");
  command->add_flag("--prebuild", options->prebuild, "compile those of the default variants into the kernel cache")
      ->required();
  addDevice(*command, *options, true);
  return {command, [options] { return runKernels(*options); }};
}

}  // namespace tessera::cli
