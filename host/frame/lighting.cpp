#include "host/frame/lighting.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace tessera::frame {
namespace {

glm::dvec3 unit(const glm::dvec3& v, const glm::dvec3& otherwise) {
  const double length = glm::length(v);
  return length > 0 && std::isfinite(length) ? v / length : otherwise;
}

}  // namespace

Lighting lightingOf(const Matrix& m) {
  const auto row = [&](int r) { return glm::dvec3(m[4 * r], m[4 * r + 1], m[4 * r + 2]); };
  const bool perspective = row(3) != glm::dvec3(0);
  // The eye looks along the gradient of w, or of depth where w is constant.
  const glm::dvec3 forward = unit(row(perspective ? 3 : 2), {0, 0, 1});
  const glm::dvec3 light = unit(-forward - 0.55 * unit(row(1), {0, 0, 0}) - 0.45 * unit(row(0), {0, 0, 0}), {0, 0, 1});

  // The eye is where x, y and w vanish together.
  const glm::dmat3 rows = glm::transpose(glm::dmat3(row(0), row(1), row(3)));
  const double determinant = glm::determinant(rows);
  glm::dvec4 eye(-forward, 0);
  if (perspective && determinant != 0 && std::isfinite(determinant))
    eye = glm::dvec4(glm::inverse(rows) * -glm::dvec3(m[3], m[7], m[15]), 1);
  const auto single = [](double v) { return static_cast<float>(v); };
  return {{single(light.x), single(light.y), single(light.z)},
          {single(eye.x), single(eye.y), single(eye.z), single(eye.w)}};
}

}  // namespace tessera::frame
