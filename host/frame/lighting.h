// Where the light and the eye are for a matrix to clip space: what shading needs beyond the scene.
#pragma once

#include <tessera/scene.h>

#include <array>

namespace tessera {

struct Lighting {
  std::array<float, 3> light;  ///< unit vector towards the light, object space
  std::array<float, 4> eye;    ///< homogeneous, object space; w is 1, or 0 where the projection is parallel
};

/// The light comes from the viewer's side, from above and a little from the left.
Lighting lightingOf(const Matrix& clipFromObject);

}  // namespace tessera
