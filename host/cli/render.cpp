// tessera render: one scene on one device, to images and a result row.
#include <fmt/format.h>
#include <tessera/image.h>
#include <tessera/kernel-cache.h>
#include <tessera/rasterizer.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "host/axes/settings.h"
#include "host/cli/commands.h"
#include "host/cli/common.h"
#include "host/cli/times.h"
#include "host/devices/open.h"
#include "host/measure/image-facts.h"
#include "host/measure/kernel-check.h"
#include "host/measure/measure.h"
#include "host/measure/render-error.h"
#include "host/measure/row.h"
#include "host/support/files.h"
#include "host/support/progress.h"
#include "host/support/table.h"
#include "host/support/terminal.h"

namespace tessera::cli {
namespace {

struct RenderOptions : Options {
  std::vector<std::string> outputs;
  std::string json;
  unsigned repeat = 1;
  bool error = false;
};

/// What is not zero, in pipeline order, in lines of at most 110 columns.
std::string countersText(const Counters& counters) {
  std::string text = "\ncounted:";
  for (const CounterDoc& doc : counterDocs()) {
    const auto found = counters.find(doc.name);
    if (found == counters.end() || found->second == 0) continue;
    const std::string item = fmt::format(" {} {},", doc.name, support::grouped(found->second));
    if (text.size() - text.rfind('\n') + item.size() > 110) text += "\n ";
    text += item;
  }
  text.back() = '\n';
  return text.substr(1);
}

std::string summary(const RenderOptions& options, const measure::Run& run, std::uint64_t covered) {
  const Scene& scene = *run.scene;
  const double pixels = static_cast<double>(scene.width) * scene.height;
  std::string text = fmt::format("{}: {} triangles, {} x {}, {} pixels covered ({:.1f} %)\n", scene.name,
                                 support::grouped(scene.triangles.size()), scene.width, scene.height,
                                 support::grouped(covered), 100.0 * static_cast<double>(covered) / pixels);
  text += fmt::format("{}{}, peak {} of buffers\n", run.device.name,
                      run.device.threads != 0 ? fmt::format(", {} threads", run.device.threads) : "",
                      support::byteSize(run.peakBufferBytes));
  if (run.device.correctnessOnly) text += "a software driver: its times say nothing about a GPU\n";
  text += timesText(run);
  text += countersText(run.counters);
  text += measure::errorSummary(run);
  if (!options.outputs.empty())
    text += fmt::format("{} ms to load OpenImageIO, beside the frame that warms up\n",
                        support::milliseconds(1e6 * finishLoadingImages()));
  for (const auto& output : options.outputs) text += fmt::format("wrote {}\n", output);
  return text;
}

/// Renders into `run`; what it holds when this throws is still worth a row.
Framebuffer renderFrames(const RenderOptions& options, Device& device, KernelCache& kernels, measure::Run& run) {
  const Scene& scene = *run.scene;
  const Variant asked = run.variant;
  const bool countWork = !options.json.empty();
  std::vector<Plan> plans{makePlan(scene, asked, run.device)};
  if (countWork) plans.push_back(makePlan(scene, axes::counting(asked), run.device));
  measure::compileKernels(kernels, plans);
  measure::checkUserKernels(scene, kernels.files(), {{deviceName(options), asked}});

  Rasterizer rasterizer(device, kernels);
  support::Progress progress("render", options.repeat + 1);
  Frame frame = measure::measureRun(run, rasterizer, kernels, options.repeat, [&](unsigned done) {
    if (done == 1 && !options.outputs.empty())
      finishLoadingImages();  // or the frames that are timed would share the cores with it
    progress.at(done);
  });
  run.peakBufferBytes = device.peakBufferBytes();
  if (countWork) {
    const Counters work = rasterizer.render(scene, asked, {.readBack = false, .countWork = true}).counters;
    for (const CounterDoc& doc : counterDocs())
      if (doc.work) run.counters[doc.name] = work.at(doc.name);
  }
  measure::measureError(run, frame.image);
  if (options.error || isApproximate(run.variant)) {
    progress.at(options.repeat + 1, "oracle");
    measure::measureAgainstOracle(run, asked, frame.image, rasterizer);
  }
  return std::move(frame.image);
}

ExitCode render(const RenderOptions& options) {
  const Variant variant = variantOf(options);
  std::vector<ImageOutput> images;
  std::vector<std::filesystem::path> outputs;
  for (const auto& output : options.outputs) outputs.push_back(images.emplace_back(output).path());
  if (!options.json.empty()) outputs.emplace_back(options.json);
  support::checkApart(outputs, inputsOf(options));
  const bool onStdout = std::ranges::any_of(outputs, support::isStdout);
  std::optional<support::AppendedFile> rows;
  if (!options.json.empty()) rows.emplace(options.json);
  KernelCache kernels({.files = kernelFilesOf(options)});
  const auto device = deviceOf(options);
  const Scene scene = sceneOf(options);
  if (!images.empty()) startLoadingImages();
  measure::Run run = measure::beginRun(scene, variant, *device, kernels);
  run.attributeRange = attributeOf(options).range;
  const auto writeRow = [&] {
    if (rows) rows->append(measure::rowText(run));
  };
  Framebuffer image;
  try {
    image = renderFrames(options, *device, kernels, run);
  } catch (const Error& error) {
    if (error.code() == ExitCode::kUsage) throw;
    run.status = measure::statusOf(error.code());
    run.message = error.what();
    writeRow();
    throw;
  }
  if (!scene.unseen && !scene.triangles.empty() && measure::coveredPixels(image) == 0)
    support::say(
        stderr,
        "warning: {}: no pixel is covered: all of it lies outside the view, between samples or edge-on to the camera\n",
        scene.name);
  const ImageFacts facts = images.empty() ? ImageFacts{} : measure::factsOf(run);
  for (auto& output : images) output.write(image, run.attributeRange, facts);
  writeRow();
  if (options.quiet) return ExitCode::kDone;
  support::say(onStdout ? stderr : stdout, "{}", summary(options, run, measure::coveredPixels(image)));
  support::say(stderr, "{}", timesWarning(run));
  return ExitCode::kDone;
}

}  // namespace

Command addRender(CLI::App& app) {
  auto options = std::make_shared<RenderOptions>();
  auto* const command = app.add_subcommand("render", "render INPUT to an image and a result row");
  addInput(*command, *options);
  command
      ->add_option(
          "-o,--output", options->outputs,
          "image: .png to look at, .exr with exact ids and depths; a pipe or - needs its format, as in png:-; may be "
          "repeated")
      ->type_name("IMAGE")
      ->allow_extra_args(false);
  addDevice(*command, *options, false);
  addSettings(*command, *options);
  addAttribute(*command, *options);
  addKernelFiles(*command, *options);
  addThreads(*command, *options);
  addRepeat(*command, options->repeat);
  addQuiet(*command, options->quiet);
  command->add_flag("--error", options->error,
                    "compare the image with the oracle's; always done where an axis is approximate");
  command->add_option("--json", options->json, "add the result row, one line of JSON, to FILE's end; - is stdout")
      ->type_name("FILE");
  command->footer(
      "Without -o and --json the frames are rendered and timed, and nothing is written. Times are those of the whole "
      "frame: median, least and greatest of --repeat frames, with a warning where they are too far apart to be "
      "compared.\n\n"
      "Examples:\n"
      "  tessera render mesh:refined_elephant -o elephant.png --set shade=smooth --size 1920x1080\n"
      "  tessera render 'generate:icosphere?level=7' --device vulkan:0 --set route=glsl -o ball.exr\n"
      "  tessera render generate:grid --attribute z --set fill=inclusive,sub-pixel=0 -o heights.exr -o heights.png\n"
      "  tessera render mesh:refined_elephant --threads 1 --repeat 50 --json rows.jsonl");
  return {command, [options] { return render(*options); }};
}

}  // namespace tessera::cli
