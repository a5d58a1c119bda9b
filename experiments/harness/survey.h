// What the planner and the kernel cache say of a sweep's cells, before anything is rendered.
#pragma once

#include <tessera/device.h>
#include <tessera/kernel-cache.h>

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "experiments/harness/cells.h"

namespace tessera::harness {

struct SurveyedPoint {
  std::optional<std::string> refused;  ///< why it cannot run here: one line
  bool deviceIsHere = true;
  /// What it is held against, as texts: cells of one scene and size that have the same share the oracle's image. One,
  /// and another of the sweep's truth where there is one.
  std::set<std::string> images;
};

struct Survey {
  std::vector<SurveyedPoint> cells;  ///< by number
  std::size_t kernels = 0;          ///< different ones
  std::vector<KernelRequest> uncompiled;
};

/// Loads each scene at each size and plans each cell on its device. A device that is not here refuses its cells. Throws
/// as loadInput does.
Survey survey(const Sweep& sweep, const std::vector<SweepPoint>& cells, KernelCache& kernels);

/// The settings that make an image of the oracle, as text.
std::string imageText(const Variant& resolved);

}  // namespace tessera::harness
