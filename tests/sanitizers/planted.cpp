// Runs one faulty kernel on the CPU device: planted KERNEL.
#include <fmt/format.h>
#include <tessera/cpu-device.h>
#include <tessera/error.h>
#include <tessera/kernel-cache.h>

#include <array>
#include <cstring>
#include <vector>

int main(int argc, char** argv) try {
  using namespace tessera;
  if (argc != 2) failUsage("usage: planted KERNEL");
  KernelCache::Options options;
  options.slangSources = KERNELS;
  KernelCache kernels(options);
  const auto device = makeCpuDevice({.threads = 4});
  const auto kernel = device->createKernel(kernels.get({argv[1], "planted.slang", argv[1], Route::kCpp, {}, ""}));
  constexpr std::uint32_t kWords = 64, kGroups = 1u << 20;
  const auto cells = device->createBuffer(4 * kWords, "cells");
  device->fill(*cells, 0, 4 * kWords, 1);
  std::vector<std::byte> block(kernel->compiled().interface.blockSize);
  const auto& fields = kernel->compiled().interface.fields;
  if (const auto words = fields.find("words"); words != fields.end())
    std::memcpy(block.data() + words->second.offset, &kWords, 4);
  device->dispatch(*kernel, std::array{Binding{"cells", cells.get()}}, block, kGroups);
  device->finish();
  std::uint32_t first = 0;
  device->read(*cells, 0, std::as_writable_bytes(std::span(&first, 1)));
  fmt::print("not noticed: cells[0] is {}\n", first);
  return 0;
} catch (const tessera::Error& error) {
  fmt::print(stderr, "planted: {}\n", error.what());
  return static_cast<int>(error.code());
}
