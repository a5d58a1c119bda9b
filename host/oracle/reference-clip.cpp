#include "host/oracle/reference-clip.h"

#include <algorithm>

namespace tessera::oracle {
namespace {

// I. E. Sutherland, G. W. Hodgman: Reentrant Polygon Clipping, CACM 17(1), 1974.
enum class Plane { kNear, kFar, kLeft, kRight, kTop, kBottom };
constexpr Plane kPlanes[] = {Plane::kNear, Plane::kFar, Plane::kLeft, Plane::kRight, Plane::kTop, Plane::kBottom};

struct Guard {
  float x, y;  ///< |x| <= guard.x w is 32767 pixels either side of the raster's centre
};

float distance(Plane plane, const glm::vec4& v, const Guard& guard) {
  switch (plane) {
    case Plane::kNear:
      return v.z;
    case Plane::kFar:
      return v.w - v.z;
    case Plane::kLeft:
      return guard.x * v.w + v.x;
    case Plane::kRight:
      return guard.x * v.w - v.x;
    case Plane::kTop:
      return guard.y * v.w + v.y;
    case Plane::kBottom:
      return guard.y * v.w - v.y;
  }
  return 0;
}

void putOnto(Plane plane, glm::vec4& v, const Guard& guard) {
  switch (plane) {
    case Plane::kNear:
      v.z = 0;
      break;
    case Plane::kFar:
      v.z = v.w;
      break;
    case Plane::kLeft:
      v.x = -(guard.x * v.w);
      break;
    case Plane::kRight:
      v.x = guard.x * v.w;
      break;
    case Plane::kTop:
      v.y = -(guard.y * v.w);
      break;
    case Plane::kBottom:
      v.y = guard.y * v.w;
      break;
  }
}

// From the inside end to the outside end, whichever way the edge runs: the triangle on its other side gets the same
// point.
glm::vec4 cross(Plane plane, const glm::vec4& in, float dIn, const glm::vec4& out, float dOut, const Guard& guard) {
  const float t = dIn / (dIn - dOut);
  glm::vec4 p(in.x + t * (out.x - in.x), in.y + t * (out.y - in.y), in.z + t * (out.z - in.z),
              in.w + t * (out.w - in.w));
  putOnto(plane, p, guard);
  return p;
}

}  // namespace

Clipped clip(const std::array<glm::vec4, 3>& triangle, std::uint32_t width, std::uint32_t height) {
  // Half extents are exact in float32: extents stay below 2^24.
  const Guard guard{32767.0f / (static_cast<float>(width) * 0.5f), 32767.0f / (static_cast<float>(height) * 0.5f)};
  Clipped result{{triangle.begin(), triangle.end()}, false};
  std::vector<glm::vec4>& polygon = result.polygon;
  for (const Plane plane : kPlanes) {
    // A distance that is NaN (clipping overflowed float32) is not >= 0, so it counts as outside.
    const auto inside = [&](const glm::vec4& v) { return distance(plane, v, guard) >= 0; };
    const auto kept = std::count_if(polygon.begin(), polygon.end(), inside);
    if (kept == std::ssize(polygon)) continue;
    result.outsideSome = true;
    std::vector<glm::vec4> rest;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const glm::vec4& current = polygon[i];
      const glm::vec4& next = polygon[(i + 1) % polygon.size()];
      const float dCurrent = distance(plane, current, guard);
      const float dNext = distance(plane, next, guard);
      if (inside(current)) rest.push_back(current);
      if (inside(current) && !inside(next)) rest.push_back(cross(plane, current, dCurrent, next, dNext, guard));
      if (!inside(current) && inside(next)) rest.push_back(cross(plane, next, dNext, current, dCurrent, guard));
    }
    polygon = std::move(rest);
  }
  return result;
}

}  // namespace tessera::oracle
