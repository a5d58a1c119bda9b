// tessera parity: every device and route here against the oracle, bit for bit.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "datasets/input.h"
#include "host/cli/commands.h"
#include "host/cli/common.h"
#include "host/cli/difference.h"
#include "host/cli/parity-report.h"
#include "host/cli/progress.h"
#include "host/kernel-cache.h"
#include "host/rasterizer.h"
#include "host/reference.h"

namespace tessera::cli {
namespace {

struct ParityOptions : Options {
  std::string json, replay = "parity-difference.replay";
  unsigned repeat = 0;
};

std::vector<Attempt> listAttempts(const ParityOptions& options, const Variant& variant) {
  std::vector<Attempt> attempts;
  for (const auto& device : options.devices.empty() ? presentDevices() : options.devices) {
    if (device == "cpu") {
      attempts.push_back({device, "cpp", variant});
      continue;
    }
    for (const std::string route : {"spirv", "glsl"}) {
      Variant routed = variant;
      if (!variant.has("route")) routed.set("route", route);
      if (routed.get("route") == route) attempts.push_back({device, route, routed});
    }
  }
  return attempts;
}

reference::Image imageAxes(const Variant& variant) {
  const std::string cull = variant.get("cull", "none");
  return {.cull = cull == "back" ? reference::Cull::kBack : cull == "front" ? reference::Cull::kFront : reference::Cull::kNone};
}

/// What the oracle expects of a frame. It does not shade: the first device's colours are what the others' are held against.
class Oracle {
 public:
  Oracle(const Scene& scene, const Variant& variant) : all_(reference::render(scene, imageAxes(variant)).image) {}

  Difference against(const Framebuffer& frame) {
    if (all_.colour.empty()) all_.colour = frame.colour;
    return compare(expected(frame), frame);
  }
  /// The oracle's image reduced to what the frame holds: hits under commit=count, depth and ids otherwise.
  Framebuffer expected(const Framebuffer& frame) const {
    Framebuffer image{.width = all_.width, .height = all_.height, .depth = {}, .ids = {}, .hits = {}, .colour = {}};
    if (!frame.depth.empty()) image.depth = all_.depth;
    if (!frame.ids.empty()) image.ids = all_.ids;
    if (!frame.hits.empty()) image.hits = all_.hits;
    if (!frame.colour.empty()) image.colour = all_.colour;
    return image;
  }

 private:
  Framebuffer all_;
};

/// Clip positions as the oracle computes them, so that the difference can be seen again on another machine without its inputs.
void writeDifference(const std::string& path, const Scene& scene) {
  Scene bare = scene;
  bare.clip = reference::transform(scene);
  bare.positions.clear();
  bare.normals.clear();
  bare.clipFromObject = kIdentity;
  writeReplay(path, bare);
}

Outcome attemptOne(const ParityOptions& options, const Scene& scene, const Attempt& attempt, Oracle& oracle, KernelCache& kernels) {
  Outcome outcome;
  outcome.attempt = attempt;
  Run& run = outcome.run;
  const auto device = openDevice(attempt.device, options.threads);
  run.scene = &scene;
  run.variant = attempt.variant;
  run.device = device->info();
  run.slang = kernels.slangc().version;
  run.kernelCompiler = kernels.cxx();
  try {
    outcome.probe = probeDevice(*device, kernels, routeOf(run.device, attempt.variant));
    Rasterizer rasterizer(*device, kernels);
    const Frame frame = rasterizer.render(scene, attempt.variant);
    run.variant = frame.plan.resolved;
    run.plan = frame.plan.entries;
    run.counters = frame.counters;
    if (options.repeat == 0) run.samples.push_back(frame.times);
    for (unsigned i = 0; i < options.repeat; ++i) run.samples.push_back(rasterizer.render(scene, attempt.variant, {.readBack = false}).times);
    run.peakBufferBytes = device->peakBufferBytes();
    outcome.covered = coveredPixels(frame.image);
    run.difference = oracle.against(frame.image);
    if (!run.difference->equal())
      outcome.note = firstPixel(*run.difference, {"oracle", oracle.expected(frame.image)}, {attempt.name(), frame.image});
  } catch (const Error& error) {
    if (error.code() == ExitCode::kUsage) throw;
    run.status = statusOf(error.code());
    run.message = outcome.note = error.what();
  }
  return outcome;
}

ExitCode runParity(const ParityOptions& options) {
  if (!options.json.empty()) checkTextPath(options.json, options.input);
  checkTextPath(options.replay, options.input);
  const Variant variant = variantOf(options);
  const auto attempts = listAttempts(options, variant);
  for (const auto& attempt : attempts) openDevice(attempt.device, options.threads);   // an absent one is refused before any work
  const Scene scene = sceneOf(options);
  KernelCache kernels;
  std::vector<Outcome> outcomes;
  {
    Progress progress("parity", attempts.size() + 1);
    progress.at(0, "oracle");
    Oracle oracle(scene, variant);
    for (const auto& attempt : attempts) {
      progress.at(outcomes.size() + 1, attempt.name());
      outcomes.push_back(attemptOne(options, scene, attempt, oracle, kernels));
    }
  }
  if (!options.json.empty()) {
    std::string rows;
    for (const auto& outcome : outcomes) rows += rowText(outcome.run) + '\n';
    writeText(options.json, rows);
  }
  fmt::print(options.json == "-" ? stderr : stdout, "{}", parityReport(scene, outcomes));
  const auto any = [&](Outcome::Verdict verdict) {
    return std::any_of(outcomes.begin(), outcomes.end(), [=](const Outcome& outcome) { return outcome.verdict() == verdict; });
  };
  if (any(Outcome::kDifferent)) {
    writeDifference(options.replay, scene);
    fmt::print(stderr, "wrote {}, which shows it again: tessera parity {}\n", options.replay, options.replay);
    return ExitCode::kDifference;
  }
  return any(Outcome::kRefused) ? ExitCode::kUnsupported : ExitCode::kDone;
}

}  // namespace

Command addParity(CLI::App& app) {
  auto options = std::make_shared<ParityOptions>();
  auto* const command = app.add_subcommand("parity", "compare every device here with the oracle; exit code 5 on a difference");
  addInput(*command, *options);
  addDevice(*command, *options, true);
  addSettings(*command, *options);
  addThreads(*command, *options);
  command->add_option("--repeat", options->repeat, "time N frames after one that warms up; without it the one frame is timed")
      ->type_name("N")->check(CLI::Range(1, 1000000));
  command->add_option("--json", options->json, "write a result row (one line of JSON) a device and route to FILE, or - for stdout")->type_name("FILE");
  command->add_option("--replay", options->replay, "where a difference leaves the scene's clip-space triangles")
      ->type_name("FILE.replay")->capture_default_str();
  command->footer("Without --device: the CPU and every Vulkan device, each Vulkan device by both routes (Slang to SPIR-V, and\n"
                  "Slang to GLSL to glslang). --set commit=count compares how often each sample is hit. The oracle does not shade:\n"
                  "colours are compared with the first device's.\n\n"
                  "Examples:\n  tessera parity bunny.obj\n"
                  "  tessera parity 'generate:soup?count=1000' --device vulkan:0 --set tile=8 --size 512x512\n\n" + inputHelp() + "\n" + axesHelp());
  return {command, [options] { return runParity(*options); }};
}

}  // namespace tessera::cli
