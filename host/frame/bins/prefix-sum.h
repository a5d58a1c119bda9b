// The prefix sum over the counts of the tiles, level by level.
#pragma once

#include "host/frame/dispatcher.h"

namespace tessera::frame {

/// Computes for each tile t
///
///     offsets[t] = tileCounts[0] + ... + tileCounts[t - 1]
///
/// and puts the sum of all counts behind the offset of the last tile.
void sumTileCounts(Dispatcher& dispatcher);

}  // namespace tessera::frame
