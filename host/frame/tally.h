// What a frame counts, and how long its stages take, over all retries, batches and bands.
#pragma once

#include <tessera/counters.h>
#include <tessera/rasterizer.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "host/frame/dispatcher.h"

namespace tessera::frame {

/// The kernels' counters, as the buffer `counters` holds them.
class KernelCounters {
 public:
  explicit KernelCounters(Dispatcher& dispatcher);
  std::uint64_t operator[](std::string_view name) const;

 private:
  std::vector<std::uint32_t> words_;  // two words for each counter, the low word first
};

/// The counters and times of one frame.
class Tally {
 public:
  Tally();

  /// Forgets what the band has counted, since the band starts, or starts again with smaller batches.
  void beginBand() { band_.clear(); }
  /// Adds `value` to the band's count, or raises the band's count to `value`, as the list of counters says.
  void count(std::string_view name, std::uint64_t value);
  /// Takes over what the kernels counted: all counters if `all` is set, otherwise the counters of the raster's work
  /// alone. Where several batches have a second pass, setup and bins run twice and count once.
  void take(const KernelCounters& kernels, bool all);
  /// Adds the band's counts to the frame's. `first` says that the band is the first one. The counts of triangles, which
  /// are the same in every band, are added for the first band alone.
  void endBand(bool first);
  /// Does for `into` what count() does for the band.
  void count(std::string_view name, std::uint64_t value, Counters& into) const;

  /// Adds the times of dispatches, in the order of the dispatches, to the times of their stages.
  void addTimes(const std::vector<StageTime>& times);
  /// Adds the time from the begin of the first of these dispatches to the end of the last one to the frame's time.
  void addTotal(const std::vector<StageTime>& times);

  Counters counters;  ///< the frame's counters
  FrameTimes times;

 private:
  Counters band_;
};

}  // namespace tessera::frame
