#include "datasets/extent.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace tessera::datasets {

bool withinFloat32(const glm::dvec3& point) {
  constexpr double most = std::numeric_limits<float>::max();
  return std::abs(point.x) <= most && std::abs(point.y) <= most && std::abs(point.z) <= most;
}

bool hasArea(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  return glm::cross(b - a, c - a) != glm::dvec3(0);
}

void Box::add(const glm::dvec3& point) {
  low = glm::min(low, point);
  high = glm::max(high, point);
}

glm::dvec3 originOf(const Box& box) {
  if (box.empty()) return glm::dvec3(0);
  const double diagonal = glm::length(box.high - box.low);
  const glm::dvec3 centre = box.centre();
  if (!(glm::length(centre) > 2 * diagonal)) return glm::dvec3(0);
  int exponent = 0;
  std::frexp(diagonal, &exponent);  // diagonal < 2^exponent <= 2 diagonal
  const auto rounded = [&](double x) {
    const double quotient = std::ldexp(x, -exponent);
    // From 2^52 on each double is a whole number; a box of one point has no diagonal.
    if (diagonal == 0 || std::abs(quotient) >= 0x1p52) return x;
    return std::ldexp(std::floor(quotient + 0.5), exponent);
  };
  return {rounded(centre.x), rounded(centre.y), rounded(centre.z)};
}

}  // namespace tessera::datasets
