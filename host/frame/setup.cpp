#include "host/frame/setup.h"

#include <algorithm>

namespace tessera::frame {

bool setUp(Dispatcher& d, const plan::Settings& settings, Tally& tally) {
  const std::uint64_t triangles = d.get("triangleCount");
  // Where growth starts: a scene of small triangles that nothing clips has no further pieces and no items.
  std::uint64_t extras = settings.clip ? std::max<std::uint64_t>(1024, triangles / 16) : 0;
  std::uint64_t items = std::max<std::uint64_t>(4096, triangles / 16);
  for (;;) {
    if (triangles + extras + items > kMaxWord) return false;
    d.set("extraCapacity", static_cast<std::uint32_t>(extras));
    d.set("itemCapacity", static_cast<std::uint32_t>(items));
    if (!d.fits("pieces") || !d.fits("items")) return false;
    d.allocate("pieces");
    d.allocate("items");
    d.zero("counters");
    d.dispatch("setup");
    const KernelCounters counted(d);
    const std::uint64_t extraCount = counted["extraPieces"], itemCount = counted["items"];
    const std::uint64_t slots = settings.compact ? counted["pieces"] : triangles + extraCount;
    d.set("slotCount", static_cast<std::uint32_t>(slots));
    d.set("itemCount", static_cast<std::uint32_t>(itemCount));
    if (extraCount <= extras && itemCount <= items) return true;
    // Pieces that had no room had none of their items counted.
    const bool uncounted = extraCount > extras;
    extras = std::max(extras, extraCount);
    items = std::max(items, uncounted ? itemCount + itemCount / 4 : itemCount);
    tally.count("retries", 1);
  }
}

}  // namespace tessera::frame
