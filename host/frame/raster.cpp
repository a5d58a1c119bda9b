#include "host/frame/raster.h"

#include <algorithm>

#include "host/frame/cuts.h"

namespace tessera::frame {
namespace {

constexpr std::uint64_t kCell = 8;               // pixels, as in slang's layout
constexpr std::uint64_t kMaxRange = 0x7fffffff;  // kernels add a range to where it begins

/// Entries of each tile that one dispatch goes through.
std::uint64_t entryRange(const plan::Settings& settings, const Bins& bins, const DeviceInfo& device) {
  const std::uint64_t across = settings.tile / kCell, cells = across * across;
  // Three walks over the tile's cells with the loop over lanes of each: to clear the tile, to load it and to store it.
  const LoopBound& loops = settings.loops;
  const std::uint64_t fixed = 9 * cells + 16 + loops.once;
  const std::uint64_t each = loops.perCell * cells + loops.perRow * across + loops.fixed;
  const std::uint64_t range = std::max<std::uint64_t>(loopsBeyond(fixed, device) / each, 1);
  return std::max(range / bins.rangeStep(), std::uint64_t{1}) * bins.rangeStep();
}

}  // namespace

void raster(Dispatcher& d, const plan::Settings& settings, const Bins& bins, bool first) {
  if (!bins.byTiles()) return d.dispatch("raster-items");
  const std::uint64_t range = entryRange(settings, bins, d.device().info());
  d.set("entryRange", static_cast<std::uint32_t>(std::min(range, kMaxRange)));
  // A tile that is not the first to write its pixels goes on from what the frame holds.
  const bool fresh = settings.commit.writesTiles && first && !d.plan().runs("clear");
  for (std::uint64_t begin = 0; begin == 0 || begin < bins.largest(); begin += range) {
    d.set("entryBegin", static_cast<std::uint32_t>(begin));
    d.set("loadFrame", fresh && begin == 0 ? 0u : 1u);
    d.dispatch("raster-tiles");
  }
}

}  // namespace tessera::frame
