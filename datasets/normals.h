#pragma once

#include <tessera/input.h>

namespace tessera::datasets {

/// Makes all normals unit length. A vertex that has none (the zero vector, or one that is not finite) gets the sum of
/// its triangles' normals weighted by their areas, and one that no triangle gives a direction (0, 0, 1).
void completeNormals(Mesh& mesh);

}  // namespace tessera::datasets
