// The stage `setup`: triangles of a batch to pieces and items, with as much room as they turn out to need.
#pragma once

#include "host/frame/dispatcher.h"
#include "host/frame/tally.h"

namespace tessera {

/// Runs setup, again with more room where pieces or items did not fit, and sets `slotCount` and `itemCount`. False
/// where a buffer would be larger than the device's largest: the triangles are cut into smaller batches then.
bool setUp(Dispatcher& dispatcher, const Settings& settings, Tally& tally);

}  // namespace tessera
