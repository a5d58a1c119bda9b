// What the plan asks of a binning. The host half of each binning answers it (host/frame/bins).
#pragma once

#include <tessera/device.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "host/plan/settings.h"

namespace tessera {

/// The frame that bins are planned for.
struct BinsLoad {
  double tiles;      ///< of the whole raster
  double triangles;  ///< of the scene
};

class BinsPlan {
 public:
  virtual ~BinsPlan() = default;
  /// Throws kUsage where the bins of this many tiles and triangles would take too long or too much memory, and
  /// kUnsupported where they would not fit the device. A message says what would do.
  virtual void check(const BinsLoad&, const DeviceInfo&) const {}
  /// The stages that build the bins, retries among them.
  virtual std::vector<std::string> stages(const Settings&) const { return {}; }
  /// Whether the raster goes by tiles, a group a tile; else by work items, a lane a work item.
  virtual bool byTiles() const { return true; }
  /// Why nothing is counted before pieces go to their bins; for a binning that does not count.
  virtual std::string whyUncounted(const Settings& settings) const {
    return "no lists of pieces (binning=" + settings.binning + ")";
  }
};

/// The binning of that name. Throws kFailure where there is none.
using BinsOf = std::function<std::unique_ptr<BinsPlan>(std::string_view binning)>;

}  // namespace tessera
