// The oracle's clipping against the six planes of the contract in rasterizer.h.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec4.hpp>
#include <vector>

namespace tessera::oracle {

struct Clipped {
  /// To be fanned from its first vertex; empty when nothing is inside, else 3 corners or more. In real numbers 9 at
  /// most, one more a plane. Rounding can bend a polygon so that a plane crosses it more than twice: n corners, k of
  /// them inside, become at most k + 2 min(k, n - k), so 4, 6, 9, 13, 19 and after all six planes 28.
  std::vector<glm::vec4> polygon;
  bool outsideSome = false;  ///< a vertex was outside a plane
};

/// `width` and `height` in pixels; the vertices are finite.
Clipped clip(const std::array<glm::vec4, 3>& triangle, std::uint32_t width, std::uint32_t height);

}  // namespace tessera::oracle
