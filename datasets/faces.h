// Faces of a file as triangles.
#pragma once

#include <tessera/input.h>

#include <cstdint>
#include <span>
#include <vector>

namespace tessera::datasets {

/// Takes the faces of a mesh in the file's order. A polygon of n corners becomes n - 2 triangles in its place.
class Faces {
 public:
  explicit Faces(Mesh& mesh) : mesh_(mesh) {}
  /// A face of fewer than 3 corners has no triangle; such faces are counted.
  void add(std::span<const std::uint32_t> corners);
  /// Once all positions are there: ear clipping for the polygons that are not convex, and notes of what was counted.
  void finish();

 private:
  struct Polygon {
    std::uint32_t first, triangles;  ///< its fan in the mesh
  };
  Mesh& mesh_;
  std::vector<Polygon> polygons_;  ///< of more than three corners
  std::uint64_t short_ = 0;        ///< faces of fewer than three
};

/// Cuts a polygon that is not convex in the plane of its Newell normal: `fan`, the n - 2 triangles of its fan from the
/// first corner, is replaced by n - 2 triangles that cover it, corners in the polygon's order. False for a convex
/// polygon, whose fan stays, and for one with no plane (no area, an index out of range, a coordinate that is not
/// finite), whose fan is as good as any other.
bool cutConcave(const std::vector<glm::dvec3>& positions, std::span<Triangle> fan);

}  // namespace tessera::datasets
