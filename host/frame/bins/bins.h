// The host half of a binning: what the binning asks of a plan, and how it fills the bins of a batch. A value of the
// axis `binning` is a line in the list of axes, a Slang file, a C++ file in this folder, and a line for the C++ file in
// list.cpp.
#pragma once

#include <tessera/device.h>

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "host/frame/dispatcher.h"
#include "host/frame/tally.h"
#include "host/plan/bins.h"

namespace tessera::frame {

/// What a binning builds its bins with.
struct BinsWork {
  Dispatcher& dispatcher;
  Tally& tally;
  const plan::Settings& settings;
};

/// The bins of one batch.
class Bins : public plan::BinsPlan {
 public:
  /// Builds the bins of the batch whose pieces setup has made. Returns false where a buffer would be larger than the
  /// device's largest buffer. The caller then cuts the triangles into smaller batches. Throws kOverflow under
  /// overflow=error.
  virtual bool build(BinsWork& work) = 0;
  /// The number of entries of the fullest tile, or an upper bound, once the bins are built. The raster goes through
  /// this number of entries.
  virtual std::uint64_t largest() const = 0;
  /// The length of the raster's ranges of entries is a multiple of this number.
  virtual std::uint64_t rangeStep() const { return 1; }
  /// Counts the entries that the bins hold, where the bins are lists.
  virtual void countEntries(BinsWork&) {}
  /// Whether tiles have lists of pieces. The buffer `tileCounts` holds the lengths of such lists.
  virtual bool listed() const { return false; }
};

/// Makes the binning of a name. Throws kFailure where no binning has the name.
std::unique_ptr<Bins> makeBins(std::string_view binning);

}  // namespace tessera::frame
