// The visibility buffer and what is resolved from it, on the host.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace tessera {

inline constexpr std::uint32_t kUnknownTriangle =
    0xfffffffeu;  ///< covered, by a commit that keeps no ids (depth32+rgba8, depth24+lum8)
inline constexpr std::uint32_t kNoTriangle = 0xffffffffu;  ///< id of an empty pixel; its depth is 1.0

/// Of an attribute: what a picture's colours span, and what errors are relative to.
struct ValueRange {
  float least = 0;  ///< in the attribute's unit
  float most = 1;   ///< in the attribute's unit, not equal to `least`
};

/// An image on the host. Row-major, row 0 at the top, width * height elements in each vector that is not empty.
struct Framebuffer {
  std::uint32_t width = 0;          ///< pixels
  std::uint32_t height = 0;         ///< pixels
  std::vector<float> depth;         ///< [+0, 1]; empty under commit=count
  std::vector<std::uint32_t> ids;   ///< triangle id or kNoTriangle; empty under commit=count
  std::vector<std::uint32_t> hits;  ///< triangles that cover the sample; only under commit=count
  std::vector<glm::vec3> colour;    ///< linear RGB, [0, 1]; only when shading was asked for
  /// The scene's attribute, only where it has one; NaN (0x7fc00000) in empty pixels and where a vertex' value is not
  /// finite.
  std::vector<float> attribute = {};

  /// width * height.
  std::size_t pixels() const { return std::size_t{width} * height; }
};

}  // namespace tessera
