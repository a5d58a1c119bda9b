// What a frame counts and how long its stages take, over retries, batches and bands.
#pragma once

#include <tessera/counters.h>
#include <tessera/rasterizer.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "host/frame/dispatcher.h"

namespace tessera {

/// The kernels' counters as they stand in the buffer `counters`.
class KernelCounters {
 public:
  explicit KernelCounters(Dispatcher& dispatcher);
  std::uint64_t operator[](std::string_view name) const;

 private:
  std::vector<std::uint32_t> words_;  // two a counter, the low one first
};

class Tally {
 public:
  Tally();

  /// Forgets what the band has counted: the band starts, or starts again with smaller batches.
  void beginBand() { band_.clear(); }
  /// Adds to what the band has counted, or raises it, as the list of counters says.
  void count(std::string_view name, std::uint64_t value);
  /// Takes over what the kernels counted; `all`: else the counters of the raster's work alone. Setup and bins run again
  /// for the second pass of several batches, and count once.
  void take(const KernelCounters& kernels, bool all);
  /// `first`: what belongs to a triangle, whatever the band, counts in the first band alone.
  void endBand(bool first);
  void count(std::string_view name, std::uint64_t value, Counters& into) const;

  /// Times of dispatches, in their order.
  void addTimes(const std::vector<StageTime>& times);
  /// From the first of these dispatches to the last: what a frame takes.
  void addTotal(const std::vector<StageTime>& times);

  Counters counters;  ///< of the frame
  FrameTimes times;

 private:
  Counters band_;
};

}  // namespace tessera
