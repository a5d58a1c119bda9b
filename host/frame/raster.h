// The raster of a batch: every tile goes through its bin, or every lane takes a work item.
#pragma once

#include "host/frame/bins/bins.h"
#include "host/frame/dispatcher.h"

namespace tessera {

/// `first`: nothing of the band has been rastered before. Tiles go through as many entries in one dispatch as the
/// device's limit on loops lets a lane.
void raster(Dispatcher& dispatcher, const Settings& settings, const Bins& bins, bool first);

}  // namespace tessera
