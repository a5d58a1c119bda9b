// Every core of a CPU: kernels as shared objects, groups spread over oneTBB.
#pragma once

#include <tessera/device.h>

#include <memory>

namespace tessera {

/// How the CPU device runs kernels.
struct CpuOptions {
  unsigned threads = 0;  ///< host threads that run kernels; 0: one thread a core
  std::uint64_t shuffleSeed =
      0;  ///< not 0: workgroups run one by one in a seeded random order (tests of order independence)
  bool plainThreads = false;  ///< std::thread instead of oneTBB (for the thread sanitizer)
};
/// Makes a CPU device, which has threads of its own and takes the route "cpp".
std::unique_ptr<Device> makeCpuDevice(const CpuOptions& options = {});

}  // namespace tessera
