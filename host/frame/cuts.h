// How a frame is cut where the device is too small for the whole frame: the raster into bands, the triangles into
// batches.
#pragma once

#include <tessera/device.h>
#include <tessera/scene.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "host/frame/dispatcher.h"
#include "host/plan/settings.h"

namespace tessera::frame {

/// Rows [begin, end) of the raster. A band begins on a row of blocks, and so on a row of cells and on a row of tiles.
struct Band {
  std::uint32_t begin, end;
};

/// Cuts the raster into bands. The pixel buffers of each band fit the device, and a lane of setup can walk the blocks
/// of a band within the device's limit on loops. The dispatcher has to have the plan's kernels.
std::vector<Band> cutBands(const Scene& scene, const plan::Settings& settings, const Dispatcher& dispatcher);

/// Triangles [first, first + count) of the scene.
struct Batch {
  std::size_t first, count;
  bool operator==(const Batch&) const = default;
};

/// Cuts each batch into two. Throws kUnsupported where a batch has one triangle only.
std::vector<Batch> halved(const std::vector<Batch>& batches, const DeviceInfo& device);

/// How many iterations of loops the device lets a lane run beyond `fixed` iterations.
std::uint64_t loopsBeyond(std::uint64_t fixed, const DeviceInfo& device);

}  // namespace tessera::frame
