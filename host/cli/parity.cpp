// tessera parity: every device and route here against the oracle, bit for bit.
#include <fmt/format.h>
#include <tessera/input.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>

#include "host/cli/commands.h"
#include "host/cli/common.h"
#include "host/cli/difference.h"
#include "host/cli/parity-replay.h"
#include "host/cli/parity-report.h"
#include "host/cli/parity-witness.h"
#include "host/devices/open.h"
#include "host/kernels/compiler-tools.h"
#include "host/measure/kernel-check.h"
#include "host/measure/measure.h"
#include "host/measure/parity-oracle.h"
#include "host/support/files.h"
#include "host/support/own-files.h"
#include "host/support/progress.h"
#include "host/support/table.h"
#include "host/support/terminal.h"

namespace tessera::cli {
namespace {

struct ParityOptions : Options {
  std::string json, replay;
  unsigned repeat = 1;
};

std::vector<Attempt> listAttempts(const ParityOptions& options) {
  const Variant variant = variantOf(options);
  std::vector<Attempt> attempts;
  for (const auto& device : options.devices.empty() ? devices::presentDevices() : options.devices)
    for (const std::string& route : devices::kindOf(device).routes) {
      if (variant.get("route", route) != route) continue;
      attempts.push_back({device, route, variant});
      attempts.back().variant.set("route", route);
    }
  if (attempts.empty())
    failUsage(fmt::format("--set route={}: no device that was named, or is here, takes it", variant.get("route")));
  return attempts;
}

/// Where a replay goes that nobody named a place for.
std::filesystem::path placeOfReplay(const Scene& scene) {
  const std::filesystem::path folder = support::defaultCacheFolder() / "replays";
  std::error_code ignored;
  std::filesystem::create_directories(folder, ignored);
  return folder / (sceneHash(scene).substr(0, 12) + ".replay");
}

class Parity {
 public:
  explicit Parity(const ParityOptions& options)
      : options_(options), attempts_(listAttempts(options)), kernels_({.files = kernelFilesOf(options)}) {
    for (const auto& attempt : attempts_)
      if (auto& device = devices_[attempt.device]; !device)
        device = openDevice(attempt.device, {.threads = options.threads});
    if (options.devices.empty()) {
      for (const DeviceKind& kind : deviceKinds())
        for (const auto& note : kind.find().notes) support::say(stderr, "{}: {}\n", kind.name, note);
      if (devices_.size() == 1 && devices_.contains(devices::defaultDevice()))
        support::say(stderr, "the {} alone is compared\n", devices::kindOf(devices::defaultDevice()).title);
    }
    scene_ = sceneOf(options);
  }

  const Scene& scene() const { return scene_; }

  std::vector<Outcome> run() {
    compileAhead();
    std::vector<Outcome> outcomes;
    support::Progress progress("parity", attempts_.size() + 1);
    progress.at(0, "oracle");
    measure::Oracle oracle(scene_, attempts_.front().variant);
    for (const auto& attempt : attempts_) {
      progress.at(outcomes.size() + 1, attempt.name());
      outcomes.push_back(tryOne(attempt, oracle));
    }
    const auto good = std::ranges::find(outcomes, Outcome::kEqual, &Outcome::verdict);
    for (auto& outcome : outcomes)
      if (outcome.verdict() == Outcome::kDifferent)
        outcome.note += "; " + (good == outcomes.end() ? stageByWitness(outcome.attempt, oracle, progress)
                                                       : stageOf(good->attempt, outcome.attempt));
    return outcomes;
  }

  /// The few triangles that show the first difference again, and how.
  struct Replay {
    Reduced reduced;
    std::string options;  ///< of the command, beside the file
  };
  std::optional<Replay> replay(const std::vector<Outcome>& outcomes) {
    const auto different = std::ranges::find(outcomes, Outcome::kDifferent, &Outcome::verdict);
    const Side side = sideOf(different->attempt);
    const auto first = std::ranges::find_if(outcomes, [](const Outcome& o) { return o.fromFirst.has_value(); });
    std::optional<Side> other;
    if (different->fromFirst) other.emplace(sideOf(first->attempt));
    auto reduced = reduceToReplay(scene_, side, other ? &*other : nullptr, kernels_.files());
    if (!reduced) return {};
    std::string text = other ? "" : " --device " + quoted(different->attempt.device);
    for (const auto& setting : typedSettings(options_))
      if (!setting.starts_with("shade=")) text += " --set " + setting;  // a replay has no normals
    for (const auto& [stage, file] : filesOfReplay(reduced->scene, side, kernels_.files()))
      text += " --kernel " + quoted(stage + "=" + file.string());
    return Replay{std::move(*reduced), text};
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
    measure::compileKernels(kernels_, plans);
    std::vector<measure::KernelRun> runs;
    for (const auto& attempt : attempts_) runs.push_back({attempt.device, attempt.variant});
    measure::checkUserKernels(scene_, kernels_.files(), runs);
  }

  Outcome tryOne(const Attempt& attempt, measure::Oracle& oracle) {
    Device& device = *devices_[attempt.device];
    Outcome outcome;
    outcome.attempt = attempt;
    measure::Run& run = outcome.run;
    run = measure::beginRun(scene_, attempt.variant, device, kernels_);
    try {
      outcome.probe = probeDevice(device, kernels_, devices::routeOf(run.device, attempt.variant));
      Rasterizer rasterizer(device, kernels_);
      const Framebuffer image = measure::measureRun(run, rasterizer, kernels_, options_.repeat).image;
      run.peakBufferBytes = device.peakBufferBytes();
      run.difference = oracle.against(image);
      if (!oracle.holdsColours())
        oracle.holdColours(image.colour);  // the first device's are what the others' have to be
      run.attributeRange = attributeOf(options_).range;
      measure::measureError(run, image);
      outcome.covered = measure::coveredPixels(image);
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
      run.status = measure::statusOf(error.code());
      run.message = outcome.note = error.what();
      outcome.refusal = error.code();
    }
    return outcome;
  }

  std::string stageOf(const Attempt& good, const Attempt& different) {
    const auto stages = [&](const Attempt& attempt) {
      return Rasterizer(*devices_[attempt.device], kernels_).render(scene_, attempt.variant, {.keepStages = true});
    };
    return measure::firstStage(stages(good), good.name(), stages(different), different.name());
  }

  Side sideOf(const Attempt& attempt) { return {*devices_[attempt.device], attempt.variant}; }

  /// Where no device is right: by a variant that is, on the same device.
  std::string stageByWitness(const Attempt& different, measure::Oracle& oracle, support::Progress& progress) {
    Device& device = *devices_[different.device];
    KernelCache own;
    for (const Witness& witness : witnesses(different.variant, !kernels_.files().empty())) {
      progress.at(attempts_.size(), different.name() + " " + witness.name);
      try {
        const FrameOptions options{.keepStages = true};
        const Frame good = Rasterizer(device, witness.files ? kernels_ : own).render(scene_, witness.variant, options);
        Difference difference = oracle.against(good.image);
        difference.colour = 0;  // the oracle's are those of the first device, which may be wrong
        if (!difference.equal()) continue;
        const Frame frame = Rasterizer(device, kernels_).render(scene_, different.variant, options);
        return fmt::format("{} {} it is as the oracle; {}", different.name(), witness.name,
                           firstStageAgainst(good, good.plan.resolved, different.name() + " " + witness.name, frame,
                                             frame.plan.resolved, different.name()));
      } catch (const Error&) {
        continue;  // what does not run is no witness
      }
    }
    return "no variant agrees with the oracle on this device, so no stage can be named";
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

void writeReplayOf(Parity& parity, const std::vector<Outcome>& outcomes, const ParityOptions& options) {
  support::flushStdout();  // what was found, before what may take a while
  std::optional<Parity::Replay> replay;
  try {
    replay = parity.replay(outcomes);
  } catch (const Error& error) {
    support::say(stderr, "no replay: {}\n", error.what());
    return;
  }
  if (!replay) {
    support::say(
        stderr,
        "no replay: it begins after the transform and ends before the shading, and between them all is equal\n");
    return;
  }
  const Scene& scene = replay->reduced.scene;
  const std::filesystem::path file =
      options.replay.empty() ? placeOfReplay(scene) : std::filesystem::path(options.replay);
  support::OutputFile output(file);
  writeReplay(output.path(), scene);
  output.commit();
  support::say(stderr, "wrote {}: {} of {} triangles{}, which show it again: tessera parity {}{}\n", file.string(),
               support::grouped(scene.triangles.size()), support::grouped(parity.scene().triangles.size()),
               replay->reduced.least ? " (none can be left out)" : " (the time for fewer was up)",
               quoted(file.string()), replay->options);
}

ExitCode runParity(const ParityOptions& options) {
  // A replay that differs again is its own replay.
  std::error_code absent;
  const bool replayed = !options.replay.empty() && std::filesystem::path(options.input).extension() == ".replay" &&
                        std::filesystem::equivalent(options.replay, options.input, absent);
  const bool replays = !options.replay.empty() && !replayed;
  std::vector<std::filesystem::path> outputs;
  if (!options.json.empty()) outputs.emplace_back(options.json);
  if (replays) outputs.emplace_back(options.replay);
  support::checkApart(outputs, inputsOf(options));
  if (replays) support::checkWhole(options.replay);
  std::optional<support::AppendedFile> file;
  if (!options.json.empty()) file.emplace(options.json);

  Parity parity(options);
  const auto outcomes = parity.run();
  if (file) {
    std::string rows;
    for (const auto& outcome : outcomes) rows += measure::rowText(outcome.run) + '\n';
    file->append(rows);
  }
  if (!options.quiet)
    support::say(file && support::isStdout(options.json) ? stderr : stdout, "{}",
                 parityReport(parity.scene(), outcomes));
  const ExitCode code = exitCode(outcomes);
  if (code == ExitCode::kDifference && !replayed) writeReplayOf(parity, outcomes, options);
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
                   "add a result row, one line of JSON, for each device and route to FILE's end; - is stdout")
      ->type_name("FILE");
  command
      ->add_option(
          "--replay", options->replay,
          "where a difference leaves the few triangles that show it, in clip space; else in the folder replays of "
          "the kernel cache")
      ->type_name("FILE");
  command->footer(
      "Without --device: the CPU and every Vulkan device, each Vulkan device by both routes (Slang to SPIR-V, and "
      "Slang to GLSL to glslang). --set commit=count compares how often each sample is hit. The oracle does not "
      "shade: colours are compared with the first device's, and so is all of an approximate variant, whose error is in "
      "the "
      "table. "
      "A difference names the first stage and element that is not as on a device that is right; where none is, not as "
      "with "
      "fewer settings or without --kernel on the same device. Its triangles are left out for up to 20 s, as long as "
      "the rest "
      "shows it, and what is left is written.\n\n"
      "Examples:\n"
      "  tessera parity mesh:refined_elephant\n"
      "  tessera parity 'generate:soup?count=1000' --device vulkan:0 --set tile=8 --size 512");
  return {command, [options] { return runParity(*options); }};
}

}  // namespace tessera::cli
