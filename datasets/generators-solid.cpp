// Closed surfaces around the origin, outward triangles counter-clockwise: seen by a perspective camera.
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <glm/geometric.hpp>

#include "datasets/generators.h"

namespace tessera::datasets {
namespace {

using HalfedgeMesh = OpenMesh::TriMesh_ArrayKernelT<>;

/// Each triangle becomes four: its corners', then the middle one. A new vertex an edge, so the half-edge mesh numbers
/// them.
void subdivide(std::vector<glm::dvec3>& positions, std::vector<Triangle>& triangles) {
  HalfedgeMesh mesh;
  mesh.reserve(positions.size(), triangles.size() * 3 / 2, triangles.size());
  for (std::size_t v = 0; v < positions.size(); ++v) mesh.add_vertex(HalfedgeMesh::Point(0, 0, 0));
  for (const Triangle& t : triangles) {
    const auto handle = [&](int i) { return OpenMesh::VertexHandle(static_cast<int>(t[static_cast<std::size_t>(i)])); };
    mesh.add_face(handle(0), handle(1), handle(2));
  }
  const auto first = static_cast<std::uint32_t>(positions.size());
  positions.resize(first + mesh.n_edges());
  for (const auto edge : mesh.edges()) {
    const auto ends = edge.halfedge(0);
    const auto at = [&](OpenMesh::VertexHandle v) { return positions[static_cast<std::size_t>(v.idx())]; };
    positions[first + static_cast<std::size_t>(edge.idx())] = glm::normalize(at(ends.from()) + at(ends.to()));
  }
  std::vector<Triangle> next;
  next.reserve(triangles.size() * 4);
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto halfedge =
        mesh.find_halfedge(OpenMesh::VertexHandle(static_cast<int>(a)), OpenMesh::VertexHandle(static_cast<int>(b)));
    return first + static_cast<std::uint32_t>(mesh.edge_handle(halfedge).idx());
  };
  for (const auto& [a, b, c] : triangles) {
    const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    next.insert(next.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  triangles = std::move(next);
}

Mesh makeIcosphere(const GeneratorValues& values) {
  // An icosahedron: three golden rectangles (0, +-1, +-phi), in each of the three orders of the axes.
  const double phi = (1 + std::sqrt(5.0)) / 2;
  std::vector<glm::dvec3> positions{{-1, phi, 0}, {1, phi, 0}, {-1, -phi, 0}, {1, -phi, 0},
                                    {0, -1, phi}, {0, 1, phi}, {0, -1, -phi}, {0, 1, -phi},
                                    {phi, 0, -1}, {phi, 0, 1}, {-phi, 0, -1}, {-phi, 0, 1}};
  for (glm::dvec3& p : positions) p = glm::normalize(p);
  std::vector<Triangle> triangles{{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                                  {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                                  {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (int level = 0; level < static_cast<int>(values[0]); ++level) subdivide(positions, triangles);
  Mesh mesh;
  mesh.triangles = std::move(triangles);
  mesh.positions = std::move(positions);
  mesh.normals.assign(mesh.positions.begin(), mesh.positions.end());
  return mesh;
}

Mesh makeTorus(const GeneratorValues& values) {
  const auto rings = static_cast<std::uint32_t>(values[0]), sides = static_cast<std::uint32_t>(values[1]);
  const double tube = values[2];
  Mesh mesh;
  for (std::uint32_t ring = 0; ring < rings; ++ring) {
    const glm::dvec2 around = circlePoint(double(ring) / rings);
    for (std::uint32_t side = 0; side < sides; ++side) {
      const glm::dvec2 across = circlePoint(double(side) / sides);
      const glm::dvec3 normal(across.x * around.x, across.x * around.y, across.y);
      mesh.positions.emplace_back(glm::dvec3(around, 0.0) + tube * normal);
      mesh.normals.emplace_back(normal);
      const std::uint32_t nextRing = (ring + 1) % rings * sides, nextSide = (side + 1) % sides, thisRing = ring * sides;
      const std::uint32_t a = thisRing + side, b = nextRing + side, c = nextRing + nextSide, d = thisRing + nextSide;
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  }
  return mesh;
}

}  // namespace

std::vector<Generator> solidGenerators() {
  return {
      {"icosphere",
       "a sphere of 20 x 4^level triangles of nearly one size",
       {{"level", 5, 0, 9}},
       false,
       makeIcosphere},
      {"torus",
       "a ring of 2 x rings x sides triangles; tube is its tube's radius",
       {{"rings", 128, 3, 4096}, {"sides", 64, 3, 4096}, {"tube", 0.4, 0.01, 1, false}},
       false,
       makeTorus},
  };
}

}  // namespace tessera::datasets
