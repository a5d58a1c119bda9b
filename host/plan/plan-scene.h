// What a scene needs of setup. The answers come from the scene's vertices.
#pragma once

#include <tessera/scene.h>

namespace tessera::plan {

/// Whether the contract's float32 arithmetic may find a vertex of the scene outside a clip plane. The answer may be
/// true where the arithmetic finds no such vertex, but is never false where the arithmetic finds one.
bool mayCross(const Scene& scene);
/// Whether every vertex that setup keeps has w = 1 exactly.
bool isOrthographic(const Scene& scene);

}  // namespace tessera::plan
