// What binning=aabb-scan and binning=bitmask share: a tile looks at every slot.
#pragma once

#include <cstdint>

#include "host/frame/bins/bins.h"

namespace tessera::frame {

/// Bins in which the raster goes through all slots of the batch for each tile.
class AllSlots : public Bins {
 public:
  bool build(BinsWork& work) override {
    slots_ = work.dispatcher.get("slotCount");
    return true;
  }
  std::uint64_t largest() const override { return slots_; }

 private:
  std::uint64_t slots_ = 0;
};

}  // namespace tessera::frame
