// Every core of a CPU: kernels as shared objects, groups spread over oneTBB.
#pragma once

#include <tessera/device.h>

#include <memory>

namespace tessera {

struct CpuOptions {
  unsigned threads = 0;  ///< 0: all cores
  std::uint64_t shuffleSeed =
      0;  ///< not 0: workgroups run one by one in a seeded random order (tests of order independence)
  bool plainThreads = false;  ///< std::thread instead of oneTBB (for the thread sanitizer)
};
std::unique_ptr<Device> makeCpuDevice(const CpuOptions& options = {});

}  // namespace tessera
