// What the host reads from the device: the channels of the framebuffer, and what the stages wrote.
#pragma once

#include <tessera/rasterizer.h>

#include "host/frame/bins/bins.h"
#include "host/frame/dispatcher.h"

namespace tessera::frame {

/// Appends the band's rows to each channel that the plan's kernels make.
void readBand(Dispatcher& dispatcher, const Scene& scene, Framebuffer& image);

/// Appends what the stages before the bins wrote, in an order that does not depend on scheduling.
void keepSetup(Dispatcher& dispatcher, const Scene& scene, const plan::Settings& settings,
               std::vector<StageOutput>& stages);
/// Appends what the later stages wrote.
void keepFrame(Dispatcher& dispatcher, const Scene& scene, const Bins& bins, std::vector<StageOutput>& stages);

}  // namespace tessera::frame
