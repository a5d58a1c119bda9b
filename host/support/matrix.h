// 4 x 4 matrices in double precision, before they are rounded for a scene.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>

namespace tessera::support {

using DoubleMatrix = std::array<double, 16>;  ///< row-major

/// M translate(by): what M makes of points from which `by` has been taken. A translation by 0 keeps every bit (-0 would
/// become 0).
inline DoubleMatrix translated(DoubleMatrix m, const glm::dvec3& by) {
  if (by == glm::dvec3(0)) return m;
  for (std::size_t r = 0; r < 16; r += 4) m[r + 3] = ((m[r] * by.x + m[r + 1] * by.y) + m[r + 2] * by.z) + m[r + 3];
  return m;
}

}  // namespace tessera::support
