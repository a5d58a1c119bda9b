#include "datasets/camera.h"

#include <cmath>
#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <limits>

namespace tessera {
namespace {

/// `slope` is the tangent of half the vertical angle. In double, and rounded once.
Matrix clipFromWorld(const Camera& camera, double slope, double aspect) {
  const double top = slope * camera.near, right = top * aspect;
  // Bottom and top change places: y points down in Vulkan's clip space.
  const glm::dmat4 clip = glm::frustumRH_ZO(-right, right, top, -top, camera.near, camera.far) *
                          glm::lookAtRH(camera.eye, camera.target, camera.up);
  Matrix matrix;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      matrix[static_cast<std::size_t>(4 * row + column)] = static_cast<float>(clip[column][row]);
  return matrix;
}

}  // namespace

Matrix perspective(const Camera& camera, std::uint32_t width, std::uint32_t height) {
  return clipFromWorld(camera, std::tan(camera.fov * (3.141592653589793 / 360)), double(width) / height);
}

Matrix frameCamera(const Mesh& mesh, std::uint32_t width, std::uint32_t height) {
  glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
  for (const glm::vec3& p : mesh.positions) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) continue;
    low = glm::min(low, glm::dvec3(p));
    high = glm::max(high, glm::dvec3(p));
  }
  if (!(low.x <= high.x)) low = high = glm::dvec3(0);
  const glm::dvec3 centre = (low + high) / 2.0;
  const double radius = low == high ? 1 : glm::length(high - low) / 2;
  // The sphere around the box touches the cone of the narrower angle at distance radius / sin; 2% of room.
  const double slope = 0.4, aspect = double(width) / height, narrow = slope * std::fmin(aspect, 1.0);
  const double distance = 1.02 * radius * std::sqrt(1 + narrow * narrow) / narrow;
  const glm::dvec3 forward = glm::normalize(glm::dvec3(0, 0.3, 1));
  const Camera camera{.eye = centre + forward * distance,
                      .target = centre,
                      .near = distance - 1.01 * radius,
                      .far = distance + 1.01 * radius};
  return clipFromWorld(camera, slope, aspect);
}

}  // namespace tessera
