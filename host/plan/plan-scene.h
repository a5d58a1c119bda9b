// What a scene needs of setup, found from its vertices.
#pragma once

#include <tessera/scene.h>

namespace tessera {

/// Whether the contract's float32 arithmetic may find a vertex of the scene outside a clip plane. May say yes where it
/// would not, never no where it would.
bool mayCross(const Scene& scene);
/// Whether every vertex that setup keeps has w = 1 exactly.
bool isOrthographic(const Scene& scene);

}  // namespace tessera
