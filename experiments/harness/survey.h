// What the planner and the kernel cache say of a sweep's cells, before anything is rendered.
#pragma once

#include <tessera/device.h>
#include <tessera/kernel-cache.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiments/harness/cells.h"

namespace tessera::harness {

struct SurveyedCell {
  std::optional<std::string> refused;  ///< why it cannot run here: one line
  bool deviceIsHere = true;
  std::string image;  ///< cells of one scene and size that have the same have one oracle's image
};

struct Survey {
  std::vector<SurveyedCell> cells;  ///< by number
  std::size_t kernels = 0;          ///< different ones
  std::vector<KernelRequest> uncompiled;
};

/// Loads each scene at each size and plans each cell on its device. A device that is not here refuses its cells. Throws
/// as loadInput does.
Survey survey(const Sweep& sweep, const std::vector<Cell>& cells, KernelCache& kernels);

/// What makes an image of the oracle, as text.
std::string imageText(const Variant& resolved);

}  // namespace tessera::harness
