// Frames: first dispatch to finished visibility buffer.
#include <fmt/format.h>

#include <map>

#include "bench/scenes.h"
#include "bench/suite.h"

namespace {

using namespace tessera;

void renderOnce(benchmark::State& state, bench::Machine& machine, const bench::BenchScene& what, std::uint32_t size) {
  const Scene scene = bench::load(what, size, size);
  const FrameOptions inPlace{.readBack = false};
  machine.rasterizer.render(scene, {}, inPlace);  // compiles, and grows buffers to their sizes
  std::map<std::string, double> stages;
  for (auto _ : state) {
    const FrameTimes times = machine.rasterizer.render(scene, {}, inPlace).times;
    state.SetIterationTime(static_cast<double>(times.totalNs) * 1e-9);
    for (const auto& [stage, ns] : times.stages) stages[stage] += static_cast<double>(ns) * 1e-6;
  }
  using benchmark::Counter;
  for (const auto& [stage, ms] : stages) state.counters[stage + "_ms"] = Counter(ms, Counter::kAvgIterations);
  state.counters["triangles/s"] = bench::rate(scene.triangles.size());
  state.counters["pixels/s"] = bench::rate(std::size_t{size} * size);
}

}  // namespace

int main(int argc, char** argv) {
  return bench::runSuite("frames", argc, argv, [](bench::Machine& machine) {
    for (const bench::BenchScene& scene : bench::scenes())
      for (const std::uint32_t size : {512u, 2048u})
        benchmark::RegisterBenchmark(
            fmt::format("frame/scene:{}/size:{}", scene.name, size).c_str(),
            [&machine, scene, size](benchmark::State& state) { renderOnce(state, machine, scene, size); })
            ->UseManualTime()
            ->Unit(benchmark::kMillisecond);
  });
}
