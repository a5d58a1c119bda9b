// The places of the light and of the eye, from the matrix to clip space. Shading needs them beside the scene.
#pragma once

#include <tessera/scene.h>

#include <array>

namespace tessera::frame {

/// Light and eye.
struct Lighting {
  std::array<float, 3> light;  ///< unit vector towards the light, in object space
  std::array<float, 4> eye;    ///< homogeneous, in object space; w is 1, or 0 where the projection is parallel
};

/// Light and eye for a matrix. The light comes from the viewer's side, from above and a little from the left.
Lighting lightingOf(const Matrix& clipFromObject);

}  // namespace tessera::frame
