// The stage `setup`, which turns the triangles of a batch into pieces and items. The host gives as much room as the
// pieces and items turn out to need.
#pragma once

#include "host/frame/dispatcher.h"
#include "host/frame/tally.h"

namespace tessera::frame {

/// Runs setup, and runs it again with more room where pieces or items did not fit. Sets `slotCount` and `itemCount`.
/// Returns false where a buffer would be larger than the device's largest buffer. The caller then cuts the triangles
/// into smaller batches.
bool setUp(Dispatcher& dispatcher, const plan::Settings& settings, Tally& tally);

}  // namespace tessera::frame
