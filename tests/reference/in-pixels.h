// Scenes from positions in pixels, so that a test can be checked with pencil and paper.
#pragma once

#include <tessera/scene.h>

#include <cstdint>
#include <vector>

namespace tessera::test {

struct PixelVertex {
  float x, y, z = 0.5f;  ///< pixels from the top left corner; depth
};

/// w = 1. Positions in 1/256 pixel arrive unrounded when width and height are powers of two.
inline Scene inPixels(std::uint32_t width, std::uint32_t height, const std::vector<PixelVertex>& vertices,
                      std::vector<Triangle> triangles) {
  Scene scene;
  scene.width = width;
  scene.height = height;
  const float halfWidth = static_cast<float>(width) / 2, halfHeight = static_cast<float>(height) / 2;
  for (const PixelVertex& v : vertices) {
    scene.clip.emplace_back((v.x - halfWidth) / halfWidth, (v.y - halfHeight) / halfHeight, v.z, 1.0f);
  }
  scene.triangles = std::move(triangles);
  return scene;
}

/// Triangles 0 1 2, 3 4 5, ... of so many vertices.
inline std::vector<Triangle> inThrees(std::size_t vertices) {
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i + 2 < vertices; i += 3) triangles.push_back({i, i + 1, i + 2});
  return triangles;
}

}  // namespace tessera::test
