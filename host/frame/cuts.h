// How a frame is cut where a device is too small for it: the raster into bands, the triangles into batches.
#pragma once

#include <tessera/device.h>
#include <tessera/scene.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "host/frame/dispatcher.h"
#include "host/plan/settings.h"

namespace tessera {

/// Rows [begin, end) of the raster. A band begins on a row of blocks, and so of cells and of tiles.
struct Band {
  std::uint32_t begin, end;
};

/// Bands whose buffers of pixels fit the device, and whose blocks a lane of setup can walk within the device's limit on
/// loops. The dispatcher has the plan's kernels.
std::vector<Band> cutBands(const Scene& scene, const Settings& settings, const Dispatcher& dispatcher);

/// Triangles [first, first + count) of the scene.
struct Batch {
  std::size_t first, count;
  bool operator==(const Batch&) const = default;
};

/// Each batch in two. Throws kUnsupported where a batch is one triangle.
std::vector<Batch> halved(const std::vector<Batch>& batches, const DeviceInfo& device);

/// Iterations that a lane has left beside `fixed` ones.
std::uint64_t loopsBeyond(std::uint64_t fixed, const DeviceInfo& device);

}  // namespace tessera
