#pragma once

#include <tessera/input.h>

#include <optional>
#include <string>
#include <vector>

#include "host/support/matrix.h"

namespace tessera::datasets {

struct PlacedMesh {
  std::string name;  ///< for messages
  Mesh mesh;
  std::optional<support::DoubleMatrix> worldFromMesh;  ///< its last row is 0, 0, 0, 1
};

/// append() of a mesh whose vertices are already where they belong in the scene.
void appendPlaced(Scene& scene, const Mesh& mesh, const std::vector<glm::vec3>& positions);
/// Puts the meshes into an empty scene: its origin, positions and normals, its attribute, its notes.
void placeMeshes(Scene& scene, std::vector<PlacedMesh> meshes, const AttributeRequest& attribute);

/// Rounds a matrix to clip space from the input's coordinates, for the scene's positions: M translate(origin), in
/// double.
Matrix clipFromPositions(const support::DoubleMatrix& clipFromInput, const glm::dvec3& origin);

}  // namespace tessera::datasets
