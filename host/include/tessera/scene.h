// What is rasterised: one triangle soup. The order of the triangles gives them their ids.
#pragma once

#include <tessera/array.h>
#include <tessera/error.h>

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace tessera {

using Triangle = std::array<std::uint32_t, 3>;  ///< vertex indices; one may be out of range, which is counted
using Matrix = std::array<float, 16>;           ///< row-major

/// The matrix that changes nothing.
inline constexpr Matrix kIdentity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
inline constexpr std::uint32_t kMaxExtent = 32768;  ///< largest width and height, pixels

/// Named data with 1 to 4 floats for each vertex. The floats of vertex v begin at values[components * v].
struct Stream {
  std::string name;         ///< unique in its scene; a kernel binds the stream by this name
  unsigned components = 1;  ///< floats for each vertex, 1 to 4
  Array<float> values;      ///< components * Scene::vertexCount() floats
  /// Whether frames get a channel of this name, which holds the stream's values between the vertices. A stream without
  /// a channel is for the stages that read the stream, as shade=smooth reads `normals`.
  bool interpolated = true;
};
/// The name of the stream of vertex normals: 3 floats for each vertex, of unit length, in object space.
inline constexpr const char* kNormals = "normals";

/// Triangles, positions, and the matrix that takes the positions to clip space.
/// Triangle i has the id i. Faces keep the file's order, polygons become fans, and meshes keep the scene's order.
/// Exactly one of `positions` and `clip` is filled (both are empty in an empty scene).
/// Arrays may be borrowed (see Array). The CPU device reads the arrays in place, and a Vulkan device copies them. When
/// render() returns, nothing of the arrays is kept.
struct Scene {
  std::string name;                   ///< what rows and messages call the scene
  std::uint32_t width = 1024;         ///< pixels, 1 to kMaxExtent
  std::uint32_t height = 1024;        ///< pixels, 1 to kMaxExtent
  Array<glm::vec3> positions;         ///< object space: the input's coordinates less `origin`
  Array<glm::vec4> clip;              ///< clip space, as replay files and tests give positions; no transform runs
  Array<Triangle> triangles;          ///< triangle i has id i
  std::vector<Stream> streams;        ///< data of the vertices; each name is unique
  Matrix clipFromObject = kIdentity;  ///< object space to clip space
  /// What loadInput() subtracted from the input's coordinates before it rounded them; 0 for a scene near 0. A frame
  /// does not depend on the origin, only on positions and matrix.
  glm::dvec3 origin{0};
  std::vector<std::string> notes;  ///< what a user would not expect of the input, a line for each fact
  bool unseen = false;             ///< the notes say why nothing can be seen of the whole scene or of one of its meshes

  /// The number of positions, in object space or in clip space.
  std::size_t vertexCount() const { return positions.empty() ? clip.size() : positions.size(); }
  /// The stream `name`. Null where the scene has no stream of this name.
  const Stream* stream(std::string_view name) const {
    for (const Stream& s : streams)
      if (s.name == name) return &s;
    return nullptr;
  }
  /// The first stream that is interpolated. Null where the scene has no such stream.
  const Stream* attribute() const {
    for (const Stream& s : streams)
      if (s.interpolated) return &s;
    return nullptr;
  }
  /// The stream `name`; makes the stream where the scene has none of this name. Throws kUsage where a stream of this
  /// name differs in `components` or `interpolated`.
  Stream& makeStream(std::string_view name, unsigned components, bool interpolated) {
    for (Stream& s : streams) {
      if (s.name != name) continue;
      if (s.components == components && s.interpolated == interpolated) return s;
      failUsage("attribute " + s.name + ": the scene has another stream of this name, with " +
                std::to_string(s.components) + " floats a vertex");
    }
    return streams.emplace_back(Stream{std::string(name), components, {}, interpolated});
  }
};

/// The streams that are interpolated, in the scene's order.
inline std::vector<const Stream*> interpolatedStreams(const Scene& scene) {
  std::vector<const Stream*> list;
  for (const Stream& stream : scene.streams)
    if (stream.interpolated) list.push_back(&stream);
  return list;
}

}  // namespace tessera
