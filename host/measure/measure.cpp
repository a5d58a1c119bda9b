#include "host/measure/measure.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tessera/error.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <set>
#include <tuple>

#include "host/axes/routes.h"
#include "host/kernels/user-kernel.h"
#include "host/oracle/oracle-image.h"
#include "host/plan/stages.h"
#include "host/support/progress.h"
#include "host/support/terminal.h"

namespace tessera::measure {

void printNotes(const Scene& scene) {
  static std::set<std::string> printed;
  for (const std::string& note : scene.notes)
    if (printed.insert(note).second) support::say(stderr, "warning: {}\n", note);
}

void compileKernels(KernelCache& kernels, const std::vector<Plan>& plans) {
  std::vector<KernelRequest> requests;
  std::set<std::tuple<std::string, std::filesystem::path, Route, VariantModules>> seen;
  const auto add = [&](std::vector<KernelRequest> more) {
    for (KernelRequest& request : more)
      if (seen.emplace(request.stage, request.file, request.route, request.modules).second)
        requests.push_back(std::move(request));
  };
  for (const auto& plan : plans) {
    add(plan::kernelRequests(plan, {}));
    try {
      if (!kernels.files().empty()) add(plan::kernelRequests(plan, kernels.files()));
    } catch (const Error& error) {
      if (error.code() == ExitCode::kUsage) throw;  // a device that cannot run a user's kernel says so when it renders
    }
  }
  support::Progress progress("compiling kernels", requests.size());
  std::set<std::string> warnings;
  for (const auto& kernel : kernels.getAll(requests, [&](std::size_t done, std::size_t) { progress.at(done); }))
    if (!kernel.file.empty()) warnings.insert(kernels::exactnessWarning(kernel));
  for (const auto& warning : warnings)
    if (!warning.empty()) support::say(stderr, "warning: {}\n", warning);
}

Run beginRun(const Scene& scene, const Variant& variant, const Device& device, const KernelCache& kernels) {
  Run run;
  run.scene = &scene;
  run.variant = variant;
  run.device = device.info();
  run.slang = kernels.slangc().version;
  try {
    run.kernelCompiler = kernels.cxx();
  } catch (const Error&) {
    const auto needed = [](const std::string& name) {
      return axes::routeNamed(name).then == axes::SecondCompiler::kCxx;
    };
    if (std::ranges::any_of(device.info().routes, needed)) throw;  // other devices do without
  }
  return run;
}

Frame measureRun(Run& run, Rasterizer& rasterizer, KernelCache& kernels, unsigned repeat,
                 const std::function<void(unsigned)>& progress) {
  const Variant asked = run.variant;
  Frame first = rasterizer.render(*run.scene, asked);
  run.variant = first.plan.resolved;
  run.plan = first.plan.entries;
  run.counters = first.counters;
  for (const auto& kernel : kernels.getAll(plan::kernelRequests(first.plan, kernels.files()))) {
    run.kernels[kernel.stage] = kernel.hash;
    if (!kernel.file.empty()) run.kernelFiles[kernel.stage] = {kernel.file.string(), kernel.fileHash};
  }
  for (unsigned i = 0; i < repeat; ++i) {
    if (progress) progress(i + 1);
    run.samples.push_back(rasterizer.render(*run.scene, asked, {.readBack = false}).times);
  }
  return first;
}

void measureError(Run& run, const Framebuffer& image) {
  if (!image.hits.empty())
    run.hitCountNotOne =
        static_cast<std::uint64_t>(std::ranges::count_if(image.hits, [](std::uint32_t hits) { return hits > 1; }));
  if (!image.channels.empty())
    run.attributeError = oracle::attributeError(*run.scene, oracle::imageAxesOf(run.variant), image);
}

std::string frameLabel(const Run& run) {
  std::vector<std::string> after;
  if (run.variant.get("shade", "none") != "none") after.push_back("shade");
  if (run.scene->attribute() != nullptr) after.push_back("attribute");
  return after.empty() ? "frame" : fmt::format("frame without {}", fmt::join(after, ", "));
}

}  // namespace tessera::measure
