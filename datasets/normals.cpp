#include "datasets/normals.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "datasets/extent.h"

namespace tessera::datasets {

void completeNormals(Mesh& mesh) {
  const std::size_t count = mesh.positions.size();
  mesh.normals.resize(count, glm::vec3(0));
  const auto usable = [](double square) { return square > 0 && square <= 1e300; };  // false for NaN too
  const auto given = [&](const glm::vec3& n) { return usable(glm::dot(glm::dvec3(n), glm::dvec3(n))); };
  std::vector<glm::dvec3> sums;
  if (!std::ranges::all_of(mesh.normals, given)) {
    sums.assign(count, glm::dvec3(0));
    const auto at = [&](std::size_t v) { return mesh.positions[v]; };
    const std::vector<bool> drawn = drawnVertices(count, mesh.triangles, at);
    Box box;
    for (std::size_t v = 0; v < count; ++v)
      if (drawn[v]) box.add(at(v));
    const glm::dvec3 origin = originOf(box);
    for (const Triangle& t : mesh.triangles) {
      if (std::ranges::any_of(t, [&](std::uint32_t v) { return v >= count; })) continue;
      // Of the positions as float32 holds them, less an origin of the mesh's own where it lies far from 0.
      const auto corner = [&](int i) { return glm::dvec3(glm::vec3(mesh.positions[t[i]] - origin)); };
      const glm::dvec3 a = corner(0), b = corner(1), c = corner(2);
      const glm::dvec3 normal = glm::cross(b - a, c - a);  // twice the area long
      if (usable(glm::dot(normal, normal)))
        for (const std::uint32_t v : t) sums[v] += normal;
    }
  }
  for (std::size_t v = 0; v < count; ++v) {
    const glm::dvec3 normal = given(mesh.normals[v]) ? glm::dvec3(mesh.normals[v]) : sums[v];
    mesh.normals[v] = usable(glm::dot(normal, normal)) ? glm::vec3(normal / glm::length(normal)) : glm::vec3(0, 0, 1);
  }
}

}  // namespace tessera::datasets
