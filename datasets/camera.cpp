#include "datasets/camera.h"

#include <cmath>
#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <vector>

#include "datasets/extent.h"

namespace tessera {
namespace {

/// `slope` is the tangent of half the vertical angle. In double, and rounded once.
Matrix clipFromWorld(const datasets::Camera& camera, double slope, double aspect) {
  const double top = slope * camera.near, right = top * aspect;
  // Bottom and top change places: y points down in Vulkan's clip space.
  glm::dmat4 clip = glm::frustumRH_ZO(-right, right, top, -top, camera.near, camera.far) *
                    glm::lookAtRH(camera.eye, camera.target, camera.up);
  // A matrix to clip space may be of any size; one that float32 has no room for is made smaller.
  double largest = 0;
  for (int i = 0; i < 16; ++i) largest = std::fmax(largest, std::abs(clip[i / 4][i % 4]));
  if (largest > 0x1p126) clip *= std::ldexp(1.0, 60 - std::ilogb(largest));
  Matrix matrix;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      matrix[static_cast<std::size_t>(4 * row + column)] = static_cast<float>(clip[column][row]);
  return matrix;
}

}  // namespace

namespace datasets {

Matrix perspective(const Camera& camera, std::uint32_t width, std::uint32_t height) {
  return clipFromWorld(camera, std::tan(camera.fov * (3.141592653589793 / 360)), double(width) / height);
}

}  // namespace datasets

Matrix frameCamera(const Scene& scene) {
  const auto at = [&](std::size_t v) { return glm::dvec3(scene.positions[v]); };
  const std::vector<bool> drawn = datasets::drawnVertices(scene.positions.size(), scene.triangles.span(), at);
  std::vector<glm::dvec3> points;
  datasets::Box box;
  for (std::size_t v = 0; v < drawn.size(); ++v) {
    if (!drawn[v]) continue;
    points.push_back(at(v));
    box.add(points.back());
  }
  if (points.empty()) box.add(glm::dvec3(0));
  const glm::dvec3 centre = box.centre();
  const double size = box.low == box.high ? 1 : glm::length(box.high - box.low);
  // The eye goes back along an axis from the box's centre until each point is inside the four sides, with 5% of room.
  const double slope = 0.4, aspect = double(scene.width) / scene.height, room = 0.95;
  const glm::dvec3 back = glm::normalize(glm::dvec3(0, 0.3, 1)), right(1, 0, 0), up = glm::cross(back, right);
  double distance = 0, nearest = 0, farthest = 0;  // along the axis, from the centre towards the eye
  for (const glm::dvec3& point : points) {
    const glm::dvec3 p = point - centre;
    const double z = glm::dot(p, back);
    const double across = std::fmax(std::abs(glm::dot(p, right)) / aspect, std::abs(glm::dot(p, up)));
    distance = std::fmax(distance, z + across / (slope * room));
    nearest = std::fmax(nearest, z);
    farthest = std::fmin(farthest, z);
  }
  distance = std::fmax(distance, nearest + 0.1 * size);
  const datasets::Camera camera{.eye = centre + back * distance,
                                .target = centre,
                                .near = 0.9 * (distance - nearest),
                                .far = 1.1 * (distance - farthest)};
  return clipFromWorld(camera, slope, aspect);
}

}  // namespace tessera
