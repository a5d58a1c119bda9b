// What the programs on Google Benchmark share: a device and its kernels, the command line, the context of the results.
#pragma once

#include <benchmark/benchmark.h>
#include <tessera/kernel-cache.h>
#include <tessera/rasterizer.h>

#include <functional>
#include <memory>

namespace tessera::bench {

struct Machine {
  explicit Machine(std::unique_ptr<Device> opened) : device(std::move(opened)) {}
  KernelCache kernels;
  std::unique_ptr<Device> device;
  Rasterizer rasterizer{*device, kernels};
};

/// main() of such a program: takes Google Benchmark's options and --device=NAME as openDevice() takes it (the
/// CPU if not given), writes build, commit, device and compilers into the context, runs what `add` registers. Returns
/// the exit status.
int runSuite(const char* program, int argc, char** argv, const std::function<void(Machine&)>& add);

/// `count` of a thing that each iteration works on, as a rate over the time that was set by hand: triangles/s,
/// pixels/s.
benchmark::Counter rate(std::size_t count);

}  // namespace tessera::bench
