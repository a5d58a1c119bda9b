// The replay that parity leaves: the few triangles, in clip space, that still show a difference.
#pragma once

#include <tessera/device.h>
#include <tessera/kernel-cache.h>

#include <optional>

#include "host/cli/parity-report.h"
#include "host/cli/reduce.h"

namespace tessera::cli {

/// One device with a variant, and the users' kernels that run there.
struct Side {
  Device& device;
  Variant variant;
};

/// Of `scene`, on which `different` is not as the oracle, or not as `first` where there is one (an approximate
/// variant). Nothing where the scene from its clip space on is equal: the difference is in what a replay leaves out,
/// the transform and the shading. Takes no longer than half a minute beside a frame.
std::optional<Reduced> reduceToReplay(const Scene& scene, const Side& different, const Side* first,
                                      const KernelFiles& files);

/// Those of `files` whose stages run on a scene that is given in clip space.
KernelFiles filesOfReplay(const Scene& replay, const Side& side, const KernelFiles& files);

}  // namespace tessera::cli
