// The visibility buffer and what is resolved from it, on the host.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace tessera {

inline constexpr std::uint32_t kUnknownTriangle =
    0xfffffffeu;  ///< covered, by a commit that keeps no ids (depth32+rgba8, depth24+lum8)
inline constexpr std::uint32_t kNoTriangle = 0xffffffffu;  ///< id of an empty pixel; its depth is 1.0

/// Row-major, row 0 at the top, width * height elements in each vector that is not empty.
struct Framebuffer {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<float> depth;         ///< [+0, 1]; empty under commit=count
  std::vector<std::uint32_t> ids;   ///< triangle id or kNoTriangle; empty under commit=count
  std::vector<std::uint32_t> hits;  ///< triangles that cover the sample; only under commit=count
  std::vector<glm::vec3> colour;    ///< linear RGB, [0, 1]; only when shading was asked for

  std::size_t pixels() const { return std::size_t{width} * height; }
};

}  // namespace tessera
