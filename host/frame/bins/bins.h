// The host half of a binning: what it asks of a plan, and how it fills the bins of a batch. A value of the axis
// `binning` is a line in the list of axes, a Slang file, a file here, and that file's line in list.cpp.
#pragma once

#include <tessera/device.h>

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "host/frame/dispatcher.h"
#include "host/frame/tally.h"
#include "host/plan/bins.h"

namespace tessera {

/// What bins are built with.
struct BinsWork {
  Dispatcher& dispatcher;
  Tally& tally;
  const Settings& settings;
};

class Bins : public BinsPlan {
 public:
  /// Builds the bins of the batch whose pieces setup has made. False where a buffer would be larger than the device's
  /// largest: the triangles are cut into smaller batches then. Throws kOverflow under overflow=error.
  virtual bool build(BinsWork& work) = 0;
  /// Entries of the fullest tile, or a bound on them, once the bins are built: the raster goes through so many.
  virtual std::uint64_t largest() const = 0;
  /// What the raster's ranges of entries are multiples of.
  virtual std::uint64_t rangeStep() const { return 1; }
  /// Counts what the bins hold, where they hold lists.
  virtual void countEntries(BinsWork&) {}
  /// Whether tiles have lists of pieces, whose lengths are in `tileCounts`.
  virtual bool listed() const { return false; }
};

/// The binning of that name. Throws kFailure where none has it.
std::unique_ptr<Bins> makeBins(std::string_view binning);

}  // namespace tessera
