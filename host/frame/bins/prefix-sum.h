// The prefix sum over the counts of tiles, level by level.
#pragma once

#include "host/frame/dispatcher.h"

namespace tessera {

/// offsets[t] = tileCounts[0] + ... + tileCounts[t - 1] for each tile t, and the sum of all behind the last.
void sumTileCounts(Dispatcher& dispatcher);

}  // namespace tessera
