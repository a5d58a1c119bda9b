// What the plan asks of a binning. The host half of each binning (host/frame/bins) has the answers.
#pragma once

#include <tessera/device.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "host/plan/settings.h"

namespace tessera::plan {

/// The frame that bins are planned for.
struct BinsLoad {
  double tiles;      ///< tiles of the whole raster
  double triangles;  ///< triangles of the scene
};

/// What one binning answers to the plan.
class BinsPlan {
 public:
  virtual ~BinsPlan() = default;
  /// Throws kUsage where bins for this load would take too long or too much memory, and kUnsupported where the bins
  /// would not fit the device. The message says what would work.
  virtual void check(const BinsLoad&, const DeviceInfo&) const {}
  /// The stages that build the bins, with the stages of retries.
  virtual std::vector<std::string> stages(const Settings&) const { return {}; }
  /// Whether the raster goes by tiles, with a group for each tile. Otherwise the raster goes by work items, with a lane
  /// for each work item.
  virtual bool byTiles() const { return true; }
  /// The reason why nothing is counted before pieces go to their bins, for a binning that does not count.
  virtual std::string whyUncounted(const Settings& settings) const {
    return "no lists of pieces (binning=" + settings.binning + ")";
  }
};

/// Gives the binning of a name. Throws kFailure where no binning has the name.
using BinsOf = std::function<std::unique_ptr<BinsPlan>(std::string_view binning)>;

}  // namespace tessera::plan
