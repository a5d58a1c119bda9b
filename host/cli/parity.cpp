// tessera parity: every device and route here against the oracle, bit for bit.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>

#include "datasets/input.h"
#include "host/cli/commands.h"
#include "host/cli/common.h"
#include "host/cli/difference.h"
#include "host/cli/measure.h"
#include "host/cli/parity-oracle.h"
#include "host/cli/parity-report.h"
#include "host/cli/progress.h"
#include "host/vulkan/vulkan-device.h"

namespace tessera::cli {
namespace {

struct ParityOptions : Options {
  std::string json, replay = "parity-difference.replay";
  unsigned repeat = 1;
};

std::vector<Attempt> listAttempts(const ParityOptions& options) {
  const Variant variant = variantOf(options);
  std::vector<Attempt> attempts;
  for (const auto& device : options.devices.empty() ? presentDevices() : options.devices)
    for (const std::string route : {"cpp", "spirv", "glsl"}) {
      if ((route == "cpp") != (device == "cpu") || variant.get("route", route) != route) continue;
      attempts.push_back({device, route, variant});
      attempts.back().variant.set("route", route);
    }
  if (attempts.empty())
    failUsage(fmt::format("--set route={}: no device that was named, or is here, takes it", variant.get("route")));
  return attempts;
}

class Parity {
 public:
  explicit Parity(const ParityOptions& options)
      : options_(options), attempts_(listAttempts(options)), kernels_({.files = kernelFilesOf(options)}) {
    for (const auto& attempt : attempts_)
      if (auto& device = devices_[attempt.device]; !device) device = openDevice(attempt.device, options.threads);
    if (options.devices.empty()) {
      for (const auto& note : listVulkanAdapters().notes) fmt::print(stderr, "vulkan: {}\n", note);
      if (devices_.size() == 1 && devices_.contains("cpu")) fmt::print(stderr, "the CPU alone is compared\n");
    }
    scene_ = sceneOf(options);
  }

  const Scene& scene() const { return scene_; }

  std::vector<Outcome> run() {
    compileAhead();
    std::vector<Outcome> outcomes;
    Progress progress("parity", attempts_.size() + 1);
    progress.at(0, "oracle");
    Oracle oracle(scene_, attempts_.front().variant);
    for (const auto& attempt : attempts_) {
      progress.at(outcomes.size() + 1, attempt.name());
      outcomes.push_back(tryOne(attempt, oracle));
    }
    const auto good = std::ranges::find(outcomes, Outcome::kEqual, &Outcome::verdict);
    for (auto& outcome : outcomes)
      if (outcome.verdict() == Outcome::kDifferent)
        outcome.note += good == outcomes.end() ? "; no device agrees with the oracle, so no stage can be named"
                                               : "; " + stageOf(good->attempt, outcome.attempt);
    return outcomes;
  }

 private:
  void compileAhead() {
    std::vector<Plan> plans;
    for (const auto& attempt : attempts_) {
      try {
        plans.push_back(makePlan(scene_, attempt.variant, devices_[attempt.device]->info()));
      } catch (const Error& error) {
        if (error.code() == ExitCode::kUsage) throw;  // a device that cannot run it says so in its own outcome
      }
    }
    compileKernels(kernels_, plans);
  }

  Outcome tryOne(const Attempt& attempt, Oracle& oracle) {
    Device& device = *devices_[attempt.device];
    Outcome outcome;
    outcome.attempt = attempt;
    Run& run = outcome.run;
    run = beginRun(scene_, attempt.variant, device, kernels_);
    try {
      outcome.probe = probeDevice(device, kernels_, routeOf(run.device, attempt.variant));
      Rasterizer rasterizer(device, kernels_);
      const Framebuffer image = measure(run, rasterizer, kernels_, options_.repeat).image;
      run.peakBufferBytes = device.peakBufferBytes();
      run.difference = oracle.against(image);
      if (!oracle.holdsColours()) oracle.holdColours(image.colour);  // the first device's are what the others' have to be
      run.attributeRange = attributeOf(options_).range;
      measureError(run, image);
      outcome.covered = coveredPixels(image);
      if (isApproximate(attempt.variant)) {
        if (!first_) first_.emplace(attempt.name(), image);
        outcome.fromFirst = compare(first_->second, image);
        if (!outcome.fromFirst->equal())
          outcome.note = firstPixel(*outcome.fromFirst, {first_->first, first_->second}, {attempt.name(), image});
      } else if (!run.difference->equal()) {
        outcome.note = firstPixel(*run.difference, {"oracle", oracle.expected(image)}, {attempt.name(), image});
      }
    } catch (const Error& error) {
      if (error.code() == ExitCode::kUsage) throw;
      run.status = statusOf(error.code());
      run.message = outcome.note = error.what();
      outcome.refusal = error.code();
    }
    return outcome;
  }

  std::string stageOf(const Attempt& good, const Attempt& different) {
    const auto stages = [&](const Attempt& attempt) {
      return Rasterizer(*devices_[attempt.device], kernels_).render(scene_, attempt.variant, {.keepStages = true});
    };
    return firstStage(stages(good), good.name(), stages(different), different.name());
  }

  const ParityOptions& options_;
  const std::vector<Attempt> attempts_;
  KernelCache kernels_;
  std::map<std::string, std::unique_ptr<Device>> devices_;
  Scene scene_;
  std::optional<std::pair<std::string, Framebuffer>> first_;  // of an approximate variant
};

ExitCode exitCode(const std::vector<Outcome>& outcomes) {
  ExitCode code = ExitCode::kDone;
  for (const auto& outcome : outcomes) {
    if (outcome.verdict() == Outcome::kDifferent) return ExitCode::kDifference;
    if (outcome.verdict() == Outcome::kRefused && code == ExitCode::kDone) code = outcome.refusal;
  }
  return code;
}

ExitCode runParity(const ParityOptions& options) {
  if (!options.json.empty()) checkOutputPath(options.json, options.input);
  // A replay that differs again is its own replay.
  std::error_code absent;
  const bool replayed = std::filesystem::equivalent(options.replay, options.input, absent);
  if (!replayed) checkOutputPath(options.replay, options.input);

  Parity parity(options);
  const auto outcomes = parity.run();
  if (!options.json.empty()) {
    std::string rows;
    for (const auto& outcome : outcomes) rows += rowText(outcome.run) + '\n';
    writeText(options.json, rows);
  }
  if (!options.quiet)
    fmt::print(options.json == "-" ? stderr : stdout, "{}", parityReport(parity.scene(), outcomes));
  const ExitCode code = exitCode(outcomes);
  if (code == ExitCode::kDifference && !replayed) {
    writeReplay(options.replay, parity.scene());
    std::string command = "tessera parity " + options.replay;
    for (const auto& setting : settingsOf(options))
      if (!setting.starts_with("shade=")) command += " --set " + setting;  // a replay has no normals
    fmt::print(stderr, "wrote {}, which shows it again: {}\n", options.replay, command);
  }
  return code;
}

}  // namespace

Command addParity(CLI::App& app) {
  auto options = std::make_shared<ParityOptions>();
  auto* const command =
      app.add_subcommand("parity", "compare every device here with the oracle; exit code 5 on a difference");
  addInput(*command, *options);
  addDevice(*command, *options, true);
  addSettings(*command, *options);
  addAttribute(*command, *options);
  addKernelFiles(*command, *options);
  addThreads(*command, *options);
  addRepeat(*command, options->repeat);
  addQuiet(*command, options->quiet);
  command
      ->add_option("--json", options->json,
                   "write a result row (a line of JSON) a device and route to FILE, or - for stdout")
      ->type_name("FILE");
  command->add_option("--replay", options->replay, "where a difference leaves the scene's clip-space triangles")
      ->type_name("FILE")
      ->capture_default_str();
  command->footer(
      "Without --device: the CPU and every Vulkan device, each Vulkan device by both routes (Slang to SPIR-V, and "
      "Slang to GLSL to glslang). --set commit=count compares how often each sample is hit. The oracle does not "
      "shade: colours are compared with the first device's, and so is all of an approximate variant, whose error is in the "
      "table.\n\n"
      "Examples:\n"
      "  tessera parity mesh:refined_elephant\n"
      "  tessera parity 'generate:soup?count=1000' --device vulkan:0 --set tile=8 --size 512");
  return {command, [options] { return runParity(*options); }};
}

}  // namespace tessera::cli
