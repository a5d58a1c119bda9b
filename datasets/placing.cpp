// Meshes to a scene's positions. The world's coordinates are double until the scene's origin is taken from them; they
// are rounded then, so that float32 holds what is seen, wherever it is.
#include "datasets/placing.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "datasets/extent.h"
#include "datasets/notes.h"

namespace tessera::datasets {
namespace {

Matrix rounded(const support::DoubleMatrix& m) {
  Matrix result;
  std::ranges::transform(m, result.begin(), [](double value) { return static_cast<float>(value); });
  return result;
}

glm::dvec3 transformed(const support::DoubleMatrix& m, const glm::dvec3& p) {
  const auto row = [&](std::size_t r) { return ((m[r] * p.x + m[r + 1] * p.y) + m[r + 2] * p.z) + m[r + 3]; };
  return {row(0), row(4), row(8)};
}

glm::dvec3 worldOf(const PlacedMesh& placed, std::size_t vertex) {
  const glm::dvec3& p = placed.mesh.positions[vertex];
  return placed.worldFromMesh ? transformed(*placed.worldFromMesh, p) : p;
}

Box boxOf(const std::vector<bool>& drawn, const std::vector<glm::dvec3>& positions) {
  Box box;
  for (std::size_t v = 0; v < positions.size(); ++v)
    if (drawn[v]) box.add(positions[v]);
  return box;
}

/// ((m0 x + m1 y) + m2 z) + m3 in float32, of coordinates that begin at the mesh's own origin: the matrix from there to
/// the scene's is worked out in double and rounded once.
std::vector<glm::vec3> positionsByMatrix(const std::vector<glm::dvec3>& positions,
                                         const support::DoubleMatrix& worldFromMesh, const glm::dvec3& own,
                                         const glm::dvec3& origin) {
  support::DoubleMatrix m = worldFromMesh;
  if (own != glm::dvec3(0) || origin != glm::dvec3(0)) {  // or -0 would become 0
    const glm::dvec3 to = transformed(worldFromMesh, own) - origin;
    m[3] = to.x, m[7] = to.y, m[11] = to.z;
  }
  const Matrix f = rounded(m);
  std::vector<glm::vec3> placed;
  placed.reserve(positions.size());
  for (const glm::dvec3& position : positions) {
    const glm::vec3 p(position - own);
    const auto row = [&](std::size_t r) { return ((f[r] * p.x + f[r + 1] * p.y) + f[r + 2] * p.z) + f[r + 3]; };
    placed.emplace_back(row(0), row(4), row(8));
  }
  return placed;
}

/// By the inverse transpose of the matrix in float32.
void turnNormals(std::vector<glm::vec3>& normals, const support::DoubleMatrix& matrix) {
  // The cofactor matrix: the inverse transpose times the determinant, there even where a matrix flattens. Its sign is
  // taken out, so that normals stay on their side under a reflection.
  const auto row = [&](std::size_t r) { return glm::dvec3(glm::vec3(matrix[r], matrix[r + 1], matrix[r + 2])); };
  const glm::dvec3 x = row(0), y = row(4), z = row(8);
  const double sign = glm::dot(x, glm::cross(y, z)) < 0 ? -1 : 1;
  const glm::dvec3 cx = glm::cross(y, z) * sign, cy = glm::cross(z, x) * sign, cz = glm::cross(x, y) * sign;
  for (glm::vec3& normal : normals) {
    const glm::dvec3 n(normal), turned(glm::dot(cx, n), glm::dot(cy, n), glm::dot(cz, n));
    const double length = glm::length(turned);
    normal = length > 0 && std::isfinite(length) ? glm::vec3(turned / length) : glm::vec3(0, 0, 1);
  }
}

}  // namespace

void placeMeshes(Scene& scene, std::vector<PlacedMesh> meshes, const AttributeRequest& attribute) {
  std::vector<std::vector<bool>> drawn;
  Box box;
  for (const PlacedMesh& placed : meshes) {
    const Mesh& mesh = placed.mesh;
    drawn.push_back(
        drawnVertices(mesh.positions.size(), mesh.triangles, [&](std::size_t v) { return worldOf(placed, v); }));
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
      if (drawn.back()[v]) box.add(worldOf(placed, v));
  }
  scene.origin = originOf(box);
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    PlacedMesh& placed = meshes[i];
    const std::size_t first = scene.positions.size();
    if (placed.worldFromMesh) {
      const auto& matrix = *placed.worldFromMesh;
      turnNormals(placed.mesh.normals, matrix);
      appendPlaced(scene, placed.mesh,
                   positionsByMatrix(placed.mesh.positions, matrix, originOf(boxOf(drawn[i], placed.mesh.positions)),
                                     scene.origin));
    } else {
      append(scene, placed.mesh);
    }
    if (attribute.isCoordinate()) {
      const int axis = attribute.name[0] - 'x';
      std::vector<float>& values = scene.makeStream(attribute.name, 1, true).values.own();
      for (std::size_t v = 0; v < placed.mesh.positions.size(); ++v)
        values.push_back(scene.origin == glm::dvec3(0) ? scene.positions[first + v][axis]
                                                       : static_cast<float>(worldOf(placed, v)[axis]));
    }
    noteMesh(scene, placed, drawn[i], first);
    placed = {};  // a large mesh need not be there twice
  }
}

Matrix clipFromPositions(const support::DoubleMatrix& clipFromInput, const glm::dvec3& origin) {
  return rounded(support::translated(clipFromInput, origin));
}

}  // namespace tessera::datasets
