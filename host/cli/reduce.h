// The few triangles of a scene that still show a difference.
#pragma once

#include <tessera/scene.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace tessera::cli {

/// A scene of those triangles, in that order, and of the vertices that they use. Its triangles have new ids. It is
/// given in clip space.
Scene withTriangles(const Scene& scene, const std::vector<std::uint32_t>& triangles);

struct Reduced {
  Scene scene;
  std::size_t tests = 0;
  bool least = false;  ///< none of its triangles can be left out; false: the time was up before that was known
};

/// Delta debugging (Zeller and Hildebrandt 2002, ddmin): `differs` says whether a scene shows it, as `scene` itself
/// does. `suspects` are sets of triangles that may do alone, the smallest first. Stops after `seconds`; `progress`
/// hears how many triangles are left.
Reduced reduceTriangles(const Scene& scene, const std::vector<std::vector<std::uint32_t>>& suspects,
                        const std::function<bool(const Scene&)>& differs, double seconds,
                        const std::function<void(std::size_t)>& progress);

}  // namespace tessera::cli
