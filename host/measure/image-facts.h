// What an image of a run depends on.
#pragma once

#include <tessera/image.h>

#include "host/measure/row.h"

namespace tessera::measure {

/// Of a frame's image: the scene's hash, its camera (clip space from the input's coordinates, row-major) and origin,
/// the raster, each axis value that is not an implementation's, the attribute and its range, the user's kernels by
/// their hashes, and the version of Tessera. Device, route, implementation axes and times are the row's alone.
ImageFacts factsOf(const Run& run);
/// The version alone: of a picture that is no frame, with what it shows.
ImageFacts factsOf(const std::string& shows);

}  // namespace tessera::measure
