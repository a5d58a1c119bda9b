#include "host/frame/bins/lists.h"

#include <algorithm>

#include "host/frame/bins/prefix-sum.h"

namespace tessera::frame {
namespace {

std::vector<std::uint32_t> tileCounts(Dispatcher& d) {
  return d.read<std::uint32_t>("tileCounts", d.count(plan::Extent::kTiles));
}

/// Whether all entries together have offsets. Only where the bound is past them are the counts themselves added up.
bool entriesFitWord(Dispatcher& d, std::uint64_t largest) {
  if (largest * d.count(plan::Extent::kTiles) <= kMaxWord) return true;
  std::uint64_t sum = 0;
  for (const std::uint32_t entries : tileCounts(d)) sum += entries;
  return sum <= kMaxWord;
}

}  // namespace

bool Lists::insertCounted(BinsWork& work) {
  Dispatcher& d = work.dispatcher;
  sumTileCounts(d);
  largest_ = KernelCounters(d)["largestBin"];
  if (!entriesFitWord(d, largest_)) return false;
  const std::uint64_t total = d.read<std::uint32_t>("offsets", 1, d.count(plan::Extent::kTiles))[0];
  d.set("entryCapacity", static_cast<std::uint32_t>(total));
  if (!d.fits("entries")) return false;
  binned_ = total;
  d.set("queueCapacity", 0u);
  insert(work, total);
  return true;
}

void Lists::insert(BinsWork& work, std::uint64_t entries) {
  Dispatcher& d = work.dispatcher;
  d.set("entryCapacity", static_cast<std::uint32_t>(entries));
  d.allocate("entries");
  d.zero("tileCounts");
  d.dispatch("bin-insert");
}

void Lists::countEntries(BinsWork& work) {
  if (!binned_) {
    // Queues that did not run again have had no prefix sum to count their entries.
    binned_ = 0;
    for (const std::uint32_t entries : tileCounts(work.dispatcher)) {
      const std::uint64_t held = std::min<std::uint64_t>(entries, work.dispatcher.get("queueCapacity"));
      *binned_ += held;
      work.tally.count("largestBin", held);
    }
  }
  work.tally.count("binned", *binned_);
}

}  // namespace tessera::frame
