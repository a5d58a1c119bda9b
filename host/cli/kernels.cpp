// tessera kernels: compiles ahead what rendering would compile at first use; writes kernels for other machines.
#include <fmt/format.h>
#include <tessera/error.h>
#include <tessera/input.h>
#include <tessera/kernel-cache.h>
#include <tessera/plan.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "host/cli/commands.h"
#include "host/cli/common.h"
#include "host/cli/manifest.h"
#include "host/devices/open.h"
#include "host/kernels/emit.h"
#include "host/measure/measure.h"
#include "host/plan/stages.h"
#include "host/support/files.h"
#include "host/support/table.h"
#include "host/support/terminal.h"

namespace tessera::cli {
namespace {

struct KernelsOptions : Options {
  bool prebuild = false;
  std::vector<std::string> emit;  ///< target and folder
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

/// Without an input: a small scene that needs the stages which most variants have.
struct ToEmit {
  Scene scene;
  Variant variant;
};
ToEmit whatToEmit(const KernelsOptions& options) {
  ToEmit what{{}, variantOf(options)};
  what.scene = options.input.empty() ? loadInput("generate:icosphere?level=1") : sceneOf(options);
  if (!options.input.empty()) return what;
  if (!what.variant.has("shade")) what.variant.set("shade", "flat");
  if (!what.variant.has("clip")) what.variant.set("clip", "on");
  return what;
}

/// manifest.json and the buffers that it names; a line where the frame could not be recorded.
std::vector<std::string> writeManifest(const std::filesystem::path& folder, const Manifest& manifest) {
  if (!manifest.files.empty()) std::filesystem::create_directories(folder / "buffers");
  for (const auto& [name, bytes] : manifest.files)
    support::writeWhole(folder / name, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  support::writeWhole(folder / "manifest.json", manifest.text);
  if (!manifest.complaint.empty())
    support::say(stderr, "manifest.json has no commands, since the frame could not be run here: {}\n",
                 manifest.complaint);
  return {"manifest", support::grouped(manifest.text.size()), (folder / "manifest.json").string()};
}

ExitCode emit(const KernelsOptions& options) {
  namespace fs = std::filesystem;
  const kernels::EmitTarget& target = kernels::emitTarget(options.emit[0]);
  const fs::path folder = options.emit[1];
  const auto [scene, variant] = whatToEmit(options);
  const Plan plan = makePlan(scene, variant, target.device);
  KernelCache kernels;
  kernels.slangc();  // throws where there is none
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder))
    failUsage(fmt::format("--emit {} {}: the folder cannot be made; a name that is free, or a folder, would do",
                          target.name, folder.string()));
  std::vector<fs::path> outputs{folder / "manifest.json"};
  for (const KernelRequest& request : plan::kernelRequests(plan, {}))
    outputs.push_back(folder / fmt::format("{}.{}", request.stage, target.extension));
  support::checkApart(outputs, inputsOf(options));
  for (const fs::path& output : outputs) support::checkWhole(output);
  std::vector<std::vector<std::string>> rows{{"stage", "bytes", "file"}};
  std::size_t missing = 0;
  std::vector<WrittenStage> stages;
  for (KernelRequest request : plan::kernelRequests(plan, {})) {
    request.route = target.route;
    const kernels::Emitted emitted = kernels::emitKernel(kernels, request, target);
    const fs::path file = folder / fmt::format("{}.{}", emitted.stage, target.extension);
    if (emitted.complaint.empty())
      support::writeWhole(file, emitted.bytes);
    else
      ++missing;
    stages.push_back({emitted, emitted.complaint.empty() ? file.filename().string() : ""});
    rows.push_back(emitted.complaint.empty()
                       ? std::vector<std::string>{emitted.stage, support::grouped(emitted.bytes.size()), file.string()}
                       : std::vector<std::string>{emitted.stage, "-", emitted.complaint});
  }
  rows.push_back(writeManifest(folder, manifestOf(scene, variant, plan, target, stages)));
  if (!options.quiet) support::say(stdout, "{}", support::table(rows));
  if (missing == 0) return ExitCode::kDone;
  support::say(stderr, "{} of {} stages cannot be written for {}: the table says why\n", missing, stages.size(),
               target.name);
  return ExitCode::kUnsupported;
}

ExitCode runKernels(const KernelsOptions& options) {
  if (options.input.empty() && !(options.size.empty() && options.attribute.empty()))
    failUsage("kernels: --size and --attribute are for an INPUT, and none is named");
  if (!options.emit.empty()) return emit(options);
  if (!options.prebuild) failUsage("kernels: nothing to do; --prebuild or --emit TARGET DIR is needed");
  if (!options.input.empty() || !options.settings.empty())
    failUsage("kernels --prebuild: takes neither INPUT nor --set; --emit does");
  std::vector<Plan> plans;
  for (const auto& name : options.devices.empty() ? devices::presentDevices() : options.devices) {
    const auto device = openDevice(name);
    for (auto& plan : defaultPlans(device->info())) plans.push_back(std::move(plan));
  }
  KernelCache kernels;
  measure::compileKernels(kernels, plans);
  const KernelCache::Statistics statistics = kernels.statistics();
  if (options.quiet) return ExitCode::kDone;
  support::say(stdout, "{} kernels of the default variants are ready in {}, {} of them compiled now\n",
               statistics.hits + statistics.compiled, kernels.folder().string(), statistics.compiled);
  return ExitCode::kDone;
}

}  // namespace

Command addKernels(CLI::App& app) {
  auto options = std::make_shared<KernelsOptions>();
  auto* const command = app.add_subcommand("kernels", "compile kernels ahead of their first use, or write them for other machines");
  auto* const prebuild =
      command->add_flag("--prebuild", options->prebuild, "compile those of the default variants into the kernel cache");
  command
      ->add_option("--emit", options->emit,
                   "write each stage of a variant into DIR, as spirv, glsl, hlsl, wgsl, metal, cuda or cpp")
      ->type_size(2)
      ->expected(1)
      ->allow_extra_args(false)
      ->type_name("TARGET DIR")
      ->excludes(prebuild);
  addInput(*command, *options);
  command->get_option("INPUT")->required(false);
  addAttribute(*command, *options);
  addSettings(*command, *options);
  addDevice(*command, *options, true);
  addQuiet(*command, options->quiet);
  command->get_option("--device")->excludes(command->get_option("--emit"));
  command->footer(
      "--emit writes the stages that the plan runs: of INPUT, else of a small scene with clipping and shading. "
      "manifest.json says how another host runs them: bindings, uniforms, sizes, and the frame of INPUT as a list of "
      "commands, with the buffers' contents beside it. "
      "That a file is written does not make it valid: host/languages.md says what was judged, and by which compiler. "
      "Exit code 4 when the target cannot take a stage.\n\n"
      "Examples:\n"
      "  tessera kernels --prebuild --device cpu\n"
      "  tessera kernels --emit wgsl out/wgsl\n"
      "  tessera kernels --emit spirv out/spirv --set commit=two-pass,tile=16");
  return {command, [options] { return runKernels(*options); }};
}

}  // namespace tessera::cli
