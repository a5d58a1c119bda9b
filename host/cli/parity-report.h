// What parity found, device by device, and how it says so.
#pragma once

#include <tessera/error.h>
#include <tessera/probe.h>

#include <optional>
#include <string>
#include <vector>

#include "host/measure/row.h"

namespace tessera::cli {

/// One device by one route.
struct Attempt {
  std::string device, route;  ///< as --device names it; a value of the axis `route`
  Variant variant;

  std::string name() const { return device + " " + route; }
};

struct Outcome {
  enum Verdict { kEqual, kNotClaimed, kDifferent, kRefused };

  Attempt attempt;
  measure::Run run;                     ///< its difference is from the oracle; none when the device could not run
  std::optional<Difference> fromFirst;  ///< of an approximate variant: from the first device that could run it
  Probe probe;  ///< of the device's arithmetic; parity is claimed only where it passed or flushes denormals
  std::uint64_t covered = 0;  ///< pixels
  ExitCode refusal{};         ///< why it could not run
  std::string note;           ///< one line on a difference or a refusal; "" when equal

  /// What has to be zero: an approximate variant differs from the oracle, but not from device to device.
  const Difference& verdictOn() const { return fromFirst ? *fromFirst : *run.difference; }
  Verdict verdict() const {
    if (!run.difference) return kRefused;
    if (!verdictOn().equal()) return kDifferent;
    return probe.passed() || probe.onlyFlushes() ? kEqual : kNotClaimed;
  }
};

/// A table of mismatches, a table of times, notes, and the verdict over all as the last line.
std::string parityReport(const Scene& scene, const std::vector<Outcome>& outcomes);

}  // namespace tessera::cli
