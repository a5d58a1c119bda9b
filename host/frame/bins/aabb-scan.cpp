// binning=aabb-scan: no bins. Each tile looks at the bounding box of every piece.
#include <fmt/format.h>
#include <tessera/error.h>

#include "host/frame/bins/all-slots.h"

namespace tessera::frame {
namespace {

constexpr double kMostBoxes = 4294967296.0;  // that a frame looks at: some seconds on two cores

class AabbScan final : public AllSlots {
 public:
  void check(const plan::BinsLoad& load, const DeviceInfo&) const override {
    const double boxes = load.tiles * load.triangles;
    if (boxes > kMostBoxes)
      failUsage(
          fmt::format("binning=aabb-scan: {} tiles would go through {} boxes each, {:.1e} a frame; up to {:.1e} "
                      "would be taken: set a larger tile, or binning=exact",
                      load.tiles, load.triangles, boxes, kMostBoxes));
  }
};

}  // namespace

std::unique_ptr<Bins> makeAabbScan() { return std::make_unique<AabbScan>(); }

}  // namespace tessera::frame
