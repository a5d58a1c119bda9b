// What binning=queue and binning=exact share: each tile has a list of slots.
#pragma once

#include <cstdint>
#include <optional>

#include "host/frame/bins/bins.h"

namespace tessera::frame {

/// Bins that are lists of slots.
class Lists : public Bins {
 public:
  std::uint64_t largest() const override { return largest_; }
  bool listed() const override { return true; }
  void countEntries(BinsWork& work) override;

 protected:
  /// Fills the lists, at the sizes that the buffer `tileCounts` holds. Returns false as build() does.
  bool insertCounted(BinsWork& work);
  /// Fills lists that have room for `entries` entries, over all tiles.
  void insert(BinsWork& work, std::uint64_t entries);

  std::uint64_t largest_ = 0;
  std::optional<std::uint64_t> binned_;  // entries of the batch; nothing: in queues, not counted yet
};

}  // namespace tessera::frame
