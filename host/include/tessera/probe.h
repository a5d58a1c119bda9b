// Does this device's arithmetic give the contract's bits? A short test at start-up; parity is claimed only where it
// passes.
#pragma once

#include <tessera/device.h>

#include <cstdint>
#include <string>
#include <vector>

namespace tessera {

class KernelCache;

/// The outcome for one kind of operation.
struct ProbeResult {
  std::string name;  ///< add, subtract, multiply, divide, square-root, floor, denormals, contraction, uint-to-float,
                     ///< two-word-to-float, int64-to-float, float-to-int, loop-limit ...
  bool required = true;  ///< parity needs it (loop-limit is information)
  bool passed = false;   ///< each result is the host's, bit for bit
  std::string detail;  ///< first failing input with both bit patterns, or the figure found
};
/// The outcome of a whole probe.
struct Probe {
  std::vector<ProbeResult> results;  ///< one for each kind of operation
  /// Whether all that parity needs has passed.
  bool passed() const {
    for (const auto& r : results)
      if (r.required && !r.passed) return false;
    return true;
  }
  /// Whether it does not pass for one reason: the device flushes denormals (floats below 1.2e-38) to zero, as Vulkan
  /// allows. Where a scene's arithmetic meets none its bits are the contract's.
  bool onlyFlushes() const;
};

/// Runs slang/stages/probe.slang on the device and compares each result with the host's, bit for bit, over edge values and
/// seeded random inputs (denormals, infinities and NaN among them where the contract can meet them). `route`: one
/// that the device takes. Throws Error where the probe cannot run.
Probe probeDevice(Device& device, KernelCache& kernels, Route route);

/// Its part about 64-bit integers, native where the device has them and as two words, over as many random inputs.
Probe probeWide(Device& device, KernelCache& kernels, Route route, std::uint32_t randomInputs);

}  // namespace tessera
