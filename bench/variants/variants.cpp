// Every legal pair of binning and traversal, and every commit, beside the default: rounds in which each cell renders a
// frame next to one of the default's, on the CPU device, in one process. What a scene makes hopeless is printed with
// the planner's reason.
#include <fmt/format.h>
#include <tessera/cpu-device.h>
#include <tessera/error.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <thread>

#include "bench/scenes.h"
#include "bench/variants/cells.h"
#include "host/plan/stages.h"
#include "host/support/files.h"
#include "host/support/progress.h"
#include "host/support/terminal.h"

namespace {

using namespace tessera;
using namespace tessera::bench;
using Clock = std::chrono::steady_clock;

struct Options {
  Limits limits;
  unsigned threads = std::max(1u, std::thread::hardware_concurrency());
  std::uint32_t size = 2048;
  std::vector<std::string> chosen;
  std::string jsonFile, svgFile = "out/bench/variants.svg";
  bool raw = false;
};

std::vector<BenchScene> benchScenes() {
  std::vector<BenchScene> all = scenes();
  all.push_back({"hot", "generate:hot"});
  return all;
}

class Measurement {
 public:
  Measurement(const Scene& scene, SceneCells& cells, const Limits& limits, Device& device, KernelCache& kernels)
      : scene_(scene),
        all_(cells),
        limits_(limits),
        kernels_(kernels),
        rasterizer_(device, kernels),
        device_(device.info()) {}

  void run() {
    compile();
    Progress progress("variants: " + all_.scene, all_.cells.size() * (limits_.rounds + 1));
    std::size_t done = 0;
    for (Cell& cell : all_.cells) {
      progress.at(done++, cell.asked.text());
      if (cell.plan) start(cell);
    }
    for (unsigned round = 0; round < limits_.rounds; ++round)
      for (std::size_t i = 0; i < all_.cells.size(); ++i) {
        // Every other round backwards: a machine that slows down or speeds up favours no cell.
        Cell& cell = all_.cells[round % 2 == 0 ? i : all_.cells.size() - 1 - i];
        progress.at(done++, cell.asked.text());
        if (wanted(cell)) measure(cell, round);
      }
  }

 private:
  /// Before any clock runs, on all cores: the timed kernels and those that count.
  void compile() {
    std::vector<KernelRequest> requests;
    for (const Cell& cell : all_.cells)
      for (const char* counters : {"basic", "work"})
        if (cell.plan) {
          Variant asked = cell.asked;
          asked.set("counters", counters);
          std::ranges::move(kernelRequests(makePlan(scene_, asked, device_), {}), std::back_inserter(requests));
        }
    Progress progress("variants: " + all_.scene + ": kernels", requests.size());
    kernels_.getAll(requests, [&](std::size_t done, std::size_t) { progress.at(done); });
  }

  FrameTimes frame(const Cell& cell) { return rasterizer_.render(scene_, cell.asked, {.readBack = false}).times; }

  template <class Work>
  void spend(Cell& cell, Work work) {
    const auto begin = Clock::now();
    work();
    cell.spentS += std::chrono::duration<double>(Clock::now() - begin).count();
  }

  /// Its counters, and a frame before any time counts: buffers grow, pages are touched. One that seems slow runs again,
  /// in case the machine stood still.
  void start(Cell& cell) {
    spend(cell, [&] {
      FrameTimes quickest = frame(cell);
      if (isSlow(quickest)) quickest = std::min(quickest, frame(cell), quicker);
      cell.slow = isSlow(quickest);
      if (cell.slow) {
        cell.frames = {quickest};
        cell.defaults = {frame(all_.cells[0])};
        cell.rounds = {0};
      }
      cell.counters = rasterizer_.render(scene_, cell.asked, {.readBack = false, .countWork = true}).counters;
    });
  }
  bool isSlow(const FrameTimes& times) const { return static_cast<double>(times.totalNs) > 1e9 * limits_.slowS; }
  static bool quicker(const FrameTimes& a, const FrameTimes& b) { return a.totalNs < b.totalNs; }

  /// Until the budget is spent; three times at least, where three quick frames would fit it: else a machine that stood
  /// still once would spend it.
  bool wanted(const Cell& cell) const {
    if (!cell.plan || cell.slow) return false;
    if (cell.frames.empty()) return true;
    const auto seconds = [](const std::vector<FrameTimes>& frames) {
      return static_cast<double>(std::ranges::min_element(frames, quicker)->totalNs) * 1e-9;
    };
    const double each = seconds(cell.frames) + seconds(cell.defaults);
    return cell.spentS + each < limits_.budgetS || (cell.frames.size() < 3 && 5 * each < limits_.budgetS);
  }

  void measure(Cell& cell, unsigned round) {
    spend(cell, [&] {
      const auto usual = [&] { cell.defaults.push_back(frame(all_.cells[0])); };
      if (round % 2 == 0) usual();
      cell.frames.push_back(frame(cell));
      if (round % 2 != 0) usual();
      cell.rounds.push_back(round);
    });
  }

  const Scene& scene_;
  SceneCells& all_;
  const Limits& limits_;
  KernelCache& kernels_;
  Rasterizer rasterizer_;
  const DeviceInfo& device_;
};

void runAll(const Options& options) {
  KernelCache kernels;
  const auto device = makeCpuDevice({.threads = options.threads});
  Report report;
  report.provenance = provenance(device->info(), kernels);
  report.limits = options.limits;
  report.size = options.size;
  for (const auto& [name, value] : report.provenance) say(stdout, "{}: {}\n", name, value);
  say(stdout,
      "up to {} rounds a cell, as many as {} s hold, beside the default; one where a frame takes longer than {} s\n",
      options.limits.rounds, options.limits.budgetS, options.limits.slowS);
  for (const BenchScene& what : benchScenes()) {
    if (!options.chosen.empty() && std::ranges::find(options.chosen, what.name) == options.chosen.end()) continue;
    const Scene scene = load(what, options.size, options.size);
    SceneCells& cells = report.scenes.emplace_back(makeCells(scene, device->info()));
    cells.scene = what.name;
    Measurement(scene, cells, options.limits, *device, kernels).run();
    say(stdout, "\n{}", text(cells, options.limits));
    std::fflush(stdout);
    // After each scene, so that what was measured stays when a later one fails.
    std::error_code ignored;  // writeWhole() says it
    const std::filesystem::path folder = std::filesystem::path(options.svgFile).parent_path();
    if (!folder.empty()) std::filesystem::create_directories(folder, ignored);
    if (!options.jsonFile.empty()) writeWhole(options.jsonFile, jsonLines(report, options.raw));
    writeWhole(options.svgFile, heatMap(report));
  }
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app{"Every legal pair of binning and traversal, and every commit, beside the default, on the CPU device."};
  std::vector<std::string> names;
  for (const BenchScene& scene : benchScenes()) names.push_back(scene.name);
  app.add_option("--rounds", options.limits.rounds, "rounds a scene")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  app.add_option("--budget", options.limits.budgetS,
                 "seconds for a cell and scene: no further round once they are spent")
      ->capture_default_str()
      ->check(CLI::Range(0.1, 3600.0));
  app.add_option("--slow", options.limits.slowS, "seconds: a cell whose frame takes longer is measured once")
      ->capture_default_str()
      ->check(CLI::Range(0.1, 3600.0));
  app.add_option("--size", options.size, "width and height, pixels")->capture_default_str()->check(CLI::Range(1, 4096));
  app.add_option("--threads", options.threads, "of the CPU device")->capture_default_str()->check(CLI::Range(1, 1024));
  app.add_option("--scene", options.chosen, "this one; may be given again")->check(CLI::IsMember(names));
  app.add_option("--json", options.jsonFile, "write medians, spreads and counters to this file, JSON Lines");
  app.add_flag("--raw", options.raw, "with --json: every frame, too")->needs("--json");
  app.add_option("--svg", options.svgFile, "write the heat maps to this file")->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::kUsage);
  }
  try {
    runAll(options);
  } catch (const Error& error) {
    say(stderr, "variants: {}\n", error.what());
    return static_cast<int>(error.code());
  }
  return 0;
}
