// Small scenes that go to the limits of the contract, the same for a seed on every machine.
#pragma once

#include <tessera/scene.h>
#include <tessera/variant.h>

#include <cstdint>

namespace tessera::test {

/// 1 to 300 triangles on a raster of 1 x 1 to 256 x 256 pixels. A scene draws first, for itself: its size (a power of
/// two in half of them, so that positions arrive on the screen unrounded); how w varies (1 everywhere; powers of two;
/// over twelve orders of magnitude; over all that float32 has); how depths vary (anything; eight levels, so that many
/// are equal; a few beyond the near or the far plane); the size of its triangles; object space with a matrix, or clip
/// space. Its vertices are then a mixture of: anywhere on the screen and around it; pixel centres and corners; 1/256
/// pixels and the ties between them; points on earlier edges; outside the screen, at the guard band and far beyond;
/// behind the eye; w of 0. Its triangles: loose ones, of shared vertices, neighbours across an earlier edge, repeated
/// ones in another order of vertices, and without area. In one scene of eight a few vertices are NaN or infinite and a
/// few indices out of range.
Scene randomScene(std::uint64_t seed);
/// As many images as it takes for each value of each image axis that the oracle follows to come up: a multiple of the
/// number of values of each.
inline constexpr std::uint64_t kImages = 12;
/// The image axes of a scene, kImages settings in turn: few, since each has raster kernels of its own.
Variant randomImage(std::uint64_t seed);

}  // namespace tessera::test
