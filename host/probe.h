// Does this device's arithmetic give the contract's bits? A short test at start-up; parity is claimed only where it
// passes.
#pragma once

#include <string>
#include <vector>

#include "host/device.h"

namespace tessera {

class KernelCache;

struct ProbeResult {
  std::string name;  ///< add, subtract, multiply, divide, square-root, floor, denormals, contraction, uint-to-float,
                     ///< int64-to-float, float-to-int, loop-limit ...
  bool required = true;  ///< parity needs it (loop-limit is information)
  bool passed = false;
  std::string detail;  ///< first failing input with both bit patterns, or the figure found
};
struct Probe {
  std::vector<ProbeResult> results;
  bool passed() const {
    for (const auto& r : results)
      if (r.required && !r.passed) return false;
    return true;
  }
};

/// Runs slang/probe.slang on the device and compares each result with the host's, bit for bit, over edge values and
/// seeded random inputs (denormals, infinities and NaN among them where the contract can meet them). `route`: kSpirv or
/// kGlsl on a Vulkan device.
Probe probeDevice(Device& device, KernelCache& kernels, Route route);

}  // namespace tessera
