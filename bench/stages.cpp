// Stages, each on scenes that give it work: the time that the device took for its dispatches, in whole frames.
#include <fmt/format.h>
#include <tessera/input.h>
#include <tessera/oracle.h>

#include <algorithm>
#include <string>
#include <vector>

#include "bench/scenes.h"
#include "bench/suite.h"

namespace {

using namespace tessera;

/// What a stage's rate counts.
enum class Element { kVertex, kTriangle, kTile, kPixel };

struct StageBench {
  const char* stage;
  const char* settings;  ///< axes that bring the stage, "axis=value axis=value"
  std::vector<const char*> scenes;
  std::vector<std::uint32_t> sizes;
  Element element;
  std::size_t bytes = 0;  ///< that an element is read and written as, where neither depends on the scene
};

/// A time by hand does not tell the library when a stage of microseconds in a frame of milliseconds has run for long
/// enough.
constexpr int kFrames = 20;

const std::vector<StageBench>& stageBenches() {
  using enum Element;
  static const std::vector<StageBench> list{
      {"clear", "commit=two-pass", {"elephant"}, {512, 2048}, kPixel, 8},        // depth and id out
      {"transform", "", {"elephant", "sphere"}, {1024}, kVertex, 12 + 16 + 16},  // position in, clip space and corner
                                                                                 // out
      {"project", "", {"clip-space-sphere"}, {1024}, kVertex, 16 + 16},          // clip space in, corner out
      {"setup", "", {"elephant", "sphere", "inside-ring"}, {1024}, kTriangle},
      {"payload", "commit=depth24+lum8 shade=flat", {"elephant", "sphere"}, {1024}, kTriangle},
      {"bin-count", "binning=exact", {"elephant", "sphere", "layers-near-to-far"}, {1024}, kTriangle},
      {"scan-blocks", "binning=exact tile=8", {"elephant"}, {2048}, kTile},
      {"scan-add", "binning=exact tile=8", {"elephant"}, {2048}, kTile},
      {"bin-insert", "binning=exact", {"elephant", "sphere", "layers-near-to-far"}, {1024}, kTriangle},
      {"raster-tiles", "", {"elephant", "sphere", "layers-far-to-near", "layers-near-to-far"}, {512, 2048}, kPixel},
      {"raster-items", "binning=none commit=two-pass", {"elephant", "sphere"}, {512, 2048}, kPixel},
      {"resolve", "commit=depth32+id32", {"elephant"}, {512, 2048}, kPixel, 8 + 8},  // a packed word in, depth and id
                                                                                     // out
      {"shade", "shade=smooth", {"elephant"}, {512, 2048}, kPixel},
      {"attribute", "", {"elephant"}, {512, 2048}, kPixel},
  };
  return list;
}

Scene sceneOf(const StageBench& bench, const std::string& name, std::uint32_t size) {
  if (name == "inside-ring") return loadInput(TESSERA_SOURCE_DIR "/datasets/scenes/inside-ring.toml", size, size);
  const bool clipSpace = name.starts_with("clip-space-");
  const auto known = std::ranges::find(bench::scenes(), clipSpace ? name.substr(11) : name, &bench::BenchScene::name);
  Scene scene = bench::load(*known, size, size);
  if (clipSpace) {
    scene.clip = oracle::transform(scene);
    scene.positions.clear();
    scene.streams.clear();
  }
  if (bench.stage == std::string("attribute"))
    for (const glm::vec3& p : scene.positions.span()) scene.makeStream("z", 1, true).values.push_back(p.z);
  return scene;
}

void count(benchmark::State& state, const StageBench& bench, const Scene& scene, const Variant& resolved) {
  const std::size_t pixels = std::size_t{scene.width} * scene.height;
  std::size_t elements = pixels;
  const char* name = "pixels/s";
  if (bench.element == Element::kVertex) elements = scene.vertexCount(), name = "vertices/s";
  if (bench.element == Element::kTriangle) elements = scene.triangles.size(), name = "triangles/s";
  if (bench.element == Element::kTile) {
    const std::size_t tile = std::stoul(resolved.get("tile"));
    elements = ((scene.width + tile - 1) / tile) * ((scene.height + tile - 1) / tile), name = "tiles/s";
  }
  state.counters[name] = bench::rate(elements);
  if (std::string_view(bench.stage).starts_with("raster-"))
    state.counters["triangles/s"] = bench::rate(scene.triangles.size());
  if (bench.bytes > 0) state.SetBytesProcessed(static_cast<std::int64_t>(elements * bench.bytes) * kFrames);
}

void stage(benchmark::State& state, bench::Machine& machine, const StageBench& bench, const std::string& name,
           std::uint32_t size) {
  const Scene scene = sceneOf(bench, name, size);
  const Variant variant(bench.settings);
  const FrameOptions inPlace{.readBack = false};
  const Frame first = machine.rasterizer.render(scene, variant, inPlace);  // compiles, and grows buffers to their sizes
  for (auto _ : state) {
    const FrameTimes times = machine.rasterizer.render(scene, variant, inPlace).times;
    const auto found = std::ranges::find(times.stages, bench.stage, [](const auto& s) { return s.first; });
    if (found == times.stages.end()) {
      state.SkipWithError("the frame did not run this stage");
      return;
    }
    state.SetIterationTime(static_cast<double>(found->second) * 1e-9);
  }
  count(state, bench, scene, first.plan.resolved);
}

std::string nameOf(const StageBench& bench, const std::string& scene, std::uint32_t size) {
  std::string name = fmt::format("stage:{}/scene:{}/size:{}", bench.stage, scene, size), settings = bench.settings;
  std::ranges::replace(settings, ' ', ',');
  return settings.empty() ? name : name + "/set:" + settings;
}

}  // namespace

int main(int argc, char** argv) {
  return bench::runSuite("stages", argc, argv, [](bench::Machine& machine) {
    for (const StageBench& bench : stageBenches())
      for (const std::string scene : bench.scenes)
        for (const std::uint32_t size : bench.sizes)
          benchmark::RegisterBenchmark(
              nameOf(bench, scene, size).c_str(),
              [&, scene, size](benchmark::State& state) { stage(state, machine, bench, scene, size); })
              ->UseManualTime()
              ->Iterations(kFrames)
              ->Unit(benchmark::kMillisecond);
  });
}
