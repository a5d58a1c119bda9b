// What binning=queue and binning=exact share: a list of slots for each tile.
#pragma once

#include <cstdint>
#include <optional>

#include "host/frame/bins/bins.h"

namespace tessera {

class Lists : public Bins {
 public:
  std::uint64_t largest() const override { return largest_; }
  bool listed() const override { return true; }
  void countEntries(BinsWork& work) override;

 protected:
  /// Fills the lists at the sizes that `tileCounts` holds.
  bool insertCounted(BinsWork& work);
  /// Fills lists that have room for `entries` in all.
  void insert(BinsWork& work, std::uint64_t entries);

  std::uint64_t largest_ = 0;
  std::optional<std::uint64_t> binned_;  // entries of the batch; empty: in queues, not counted yet
};

}  // namespace tessera
