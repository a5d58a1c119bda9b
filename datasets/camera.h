#pragma once

#include <tessera/input.h>

#include <glm/vec3.hpp>

namespace tessera::datasets {

/// A perspective camera in world units; `fov` is the vertical angle in degrees.
struct Camera {
  glm::dvec3 eye, target, up{0, 1, 0};
  double fov = 45, near = 0.1, far = 100;
};
/// Vulkan's clip space: y down, 0 <= z <= w. The camera must have passed the checks of scene-file.cpp.
Matrix perspective(const Camera& camera, std::uint32_t width, std::uint32_t height);

}  // namespace tessera::datasets
