// The raster of a batch. Either every tile goes through its bin, or every lane takes a work item.
#pragma once

#include "host/frame/bins/bins.h"
#include "host/frame/dispatcher.h"

namespace tessera::frame {

/// Rasters a batch. `first` says that nothing of the band has been rastered before. In one dispatch a tile goes through
/// as many entries as a lane can within the device's limit on loops.
void raster(Dispatcher& dispatcher, const plan::Settings& settings, const Bins& bins, bool first);

}  // namespace tessera::frame
