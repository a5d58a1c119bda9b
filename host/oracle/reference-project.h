// The contract's sections Project and Snap.
#pragma once

#include <tessera/oracle.h>

#include <cstdint>
#include <glm/vec4.hpp>
#include <optional>

namespace tessera::oracle {

struct Snapped {
  std::int32_t x, y;  ///< 1/256 pixel, |.| <= 2^24
  float z;
};

/// Of a finite clip-space position. Nothing where the contract counts the piece as behind.
std::optional<Snapped> project(const glm::vec4& v, const Scene& scene, const ImageAxes& axes);

}  // namespace tessera::oracle
