// Frames of the CPU device: first dispatch to finished visibility buffer.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <map>
#include <memory>

#include "bench/scenes.h"
#include "host/cpu/cpu-device.h"
#include "host/error.h"
#include "host/rasterizer.h"

namespace {

using namespace tessera;

struct Machine {
  KernelCache kernels;
  std::unique_ptr<Device> device = makeCpuDevice();
  Rasterizer rasterizer{*device, kernels};
};

void frame(benchmark::State& state, Machine& machine, const bench::BenchScene& what, std::uint32_t size) {
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
  const double pixels = double{1} * size * size;
  state.counters["triangles/s"] = Counter(static_cast<double>(scene.triangles.size()), Counter::kIsIterationInvariantRate);
  state.counters["pixels/s"] = Counter(pixels, Counter::kIsIterationInvariantRate);
}

}  // namespace

int main(int argc, char** argv) try {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return static_cast<int>(ExitCode::kUsage);
  Machine machine;
  for (const auto& [name, value] : bench::provenance(machine.device->info(), machine.kernels))
    benchmark::AddCustomContext(name, value);  // Debian's library says of itself that it is a debug build
  for (const bench::BenchScene& scene : bench::scenes())
    for (const std::uint32_t size : {512u, 2048u})
      benchmark::RegisterBenchmark(fmt::format("frame/scene:{}/size:{}", scene.name, size).c_str(),
                                   [&machine, scene, size](benchmark::State& state) { frame(state, machine, scene, size); })
          ->UseManualTime()
          ->Unit(benchmark::kMillisecond);
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
} catch (const tessera::Error& error) {
  fmt::print(stderr, "frames: {}\n", error.what());
  return static_cast<int>(error.code());
}
