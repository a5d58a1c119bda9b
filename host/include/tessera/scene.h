// What is rasterised: one triangle soup, in the order that gives triangles their ids.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

namespace tessera {

using Triangle = std::array<std::uint32_t, 3>;  ///< vertex indices; may be out of range, the pipeline counts those
using Matrix = std::array<float, 16>;           ///< row-major

/// The matrix that changes nothing.
inline constexpr Matrix kIdentity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
inline constexpr std::uint32_t kMaxExtent = 32768;  ///< largest width and height, pixels

/// Triangles, positions and the matrix that takes them to clip space.
/// Triangle i has id i: faces in the file's order, polygons fanned, meshes in the scene's order.
/// Exactly one of `positions` and `clip` is filled (both are empty in an empty scene).
struct Scene {
  std::string name;                  ///< for rows and messages
  std::uint32_t width = 1024;        ///< pixels, 1 to kMaxExtent
  std::uint32_t height = 1024;       ///< pixels, 1 to kMaxExtent
  std::vector<glm::vec3> positions;  ///< object space: the input's coordinates less `origin`
  std::vector<glm::vec4> clip;       ///< clip space, given as they are (replay files, tests): no transform runs
  std::vector<glm::vec3> normals;    ///< empty, or unit length, one a vertex, object space
  std::vector<float> attribute;      ///< empty, or one a vertex: frames get a raster of these values, too
  std::string attributeName;         ///< of it
  std::vector<Triangle> triangles;   ///< triangle i has id i
  Matrix clipFromObject = kIdentity;  ///< object space to clip space
  /// What loadInput() took from the input's coordinates before it rounded them; 0 for a scene near 0. A frame depends
  /// on positions and matrix alone.
  glm::dvec3 origin{0};
  std::vector<std::string> notes;  ///< one line each: what a user would not expect of the input
  bool unseen = false;  ///< the notes say why nothing can be seen of the whole scene or of one of its meshes

  /// How many positions there are, of whichever space.
  std::size_t vertexCount() const { return positions.empty() ? clip.size() : positions.size(); }
};

}  // namespace tessera
