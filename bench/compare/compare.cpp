// The CPU device against lavapipe's own graphics pipeline, on the same cores of the same machine in the same minutes: rounds in which
// both render each scene, in turn. The draw is given vertices in clip space; the CPU device transforms them within its time.
#include <fmt/format.h>
#include <tessera/cpu-device.h>
#include <tessera/error.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <thread>

#include "bench/compare/measure.h"
#include "bench/draw-baseline/draw.h"
#include "host/measure/row.h"
#include "host/support/files.h"
#include "host/support/terminal.h"

namespace {

using namespace tessera;
using namespace tessera::bench;

struct Options {
  unsigned rounds = 21, threads = std::max(1u, std::thread::hardware_concurrency());
  std::uint32_t size = 2048;
  std::vector<std::string> chosen;
  std::string jsonFile, memoryOf;
  bool raw = false;
};

Comparison compareScene(const BenchScene& what, const Options& options, Rasterizer& rasterizer, std::string& drawDevice) {
  const Scene scene = load(what, options.size, options.size);
  DrawBaseline draw(scene, "llvmpipe");
  drawDevice = draw.device();
  Comparison result;
  result.scene = what.name;
  result.triangles = scene.triangles.size();
  result.size = options.size;

  // Once each before any clock counts: kernels compile, buffers grow, pages are touched.
  const Framebuffer image = rasterizer.render(scene).image;
  result.difference = compare(image, draw.framebuffer());
  result.covered = measure::coveredPixels(image);

  const auto cpu = [&](std::vector<FrameTimes>& into) { into.push_back(rasterizer.render(scene, {}, {.readBack = false}).times); };
  const auto drawn = [&] {
    const DrawTime time = draw.time();
    result.drawDevice.push_back(time.deviceNs);
    result.drawWall.push_back(time.wallNs);
  };
  for (unsigned round = 0; round < options.rounds; ++round) {
    // Every other round backwards: a machine that slows down or speeds up favours neither.
    const bool forwards = round % 2 == 0;
    cpu(forwards ? result.cpu : result.again);
    drawn();
    cpu(forwards ? result.again : result.cpu);
  }
  return result;
}

void runAll(const Options& options) {
  // lavapipe reads it when it is loaded: as many threads as the CPU device has.
  setenv("LP_NUM_THREADS", std::to_string(options.threads).c_str(), 1);
  if (!options.jsonFile.empty()) support::checkWhole(options.jsonFile);
  KernelCache kernels;
  const auto device = makeCpuDevice({.threads = options.threads});
  Rasterizer rasterizer(*device, kernels);
  Report report;
  report.provenance = provenance(device->info(), kernels);
  for (const BenchScene& scene : scenes()) {
    if (!options.chosen.empty() && std::ranges::find(options.chosen, scene.name) == options.chosen.end()) continue;
    support::say(stderr, "compare: {}, {} rounds\n", scene.name, options.rounds);
    report.comparisons.push_back(compareScene(scene, options, rasterizer, report.drawDevice));
  }
  report.drawDevice += fmt::format(", LP_NUM_THREADS={}", options.threads);
  report.memory.push_back(measureMemory("sphere", options.size, options.threads));
  support::say(stdout, "{}", text(report));
  if (!options.jsonFile.empty()) support::writeWhole(options.jsonFile, json(report, options.raw));
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app{"The CPU device against lavapipe's graphics pipeline, interleaved; and the memory of a frame of 1.3 million triangles."};
  std::vector<std::string> names;
  for (const BenchScene& scene : scenes()) names.push_back(scene.name);
  app.add_option("--rounds", options.rounds, "rounds a scene")->capture_default_str()->check(CLI::Range(1, 10000));
  app.add_option("--size", options.size, "width and height, pixels")->capture_default_str()->check(CLI::Range(1, 4096));
  app.add_option("--threads", options.threads, "of the CPU device and of lavapipe")->capture_default_str()->check(CLI::Range(1, 1024));
  app.add_option("--scene", options.chosen, "this one; may be given again")->check(CLI::IsMember(names));
  app.add_option("--json", options.jsonFile, "write the figures to this file");
  app.add_flag("--raw", options.raw, "with --json: every sample, too");
  app.add_option("--memory-of", options.memoryOf, "render this scene once; print the process's peak bytes and the buffers'");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::kUsage);
  }
  try {
    if (options.memoryOf.empty()) runAll(options);
    else printMemory(options.memoryOf, options.size, options.threads);
  } catch (const Error& error) {
    support::say(stderr, "compare: {}\n", error.what());
    return static_cast<int>(error.code());
  }
  return 0;
}
