// What is rasterised: one triangle soup, in the order that gives triangles their ids.
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

using Triangle = std::array<std::uint32_t, 3>;  ///< vertex indices; may be out of range, the pipeline counts those
using Matrix = std::array<float, 16>;           ///< row-major

/// The matrix that changes nothing.
inline constexpr Matrix kIdentity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
inline constexpr std::uint32_t kMaxExtent = 32768;  ///< largest width and height, pixels

/// Named data with 1 to 4 floats a vertex. Vertex v has the floats from values[components * v] on.
struct Stream {
  std::string name;         ///< unique in its scene; a kernel binds the stream by this name
  unsigned components = 1;  ///< floats a vertex, 1 to 4
  Array<float> values;      ///< components * Scene::vertexCount() of them
  /// Whether frames get a channel of this name, which holds the stream's values between the vertices. Other streams are
  /// there for the stages that read them, as shade=smooth reads `normals`.
  bool interpolated = true;
};
/// The stream of vertex normals: 3 floats, unit length, object space.
inline constexpr const char* kNormals = "normals";

/// Triangles, positions and the matrix that takes them to clip space.
/// Triangle i has id i: faces in the file's order, polygons fanned, meshes in the scene's order.
/// Exactly one of `positions` and `clip` is filled (both are empty in an empty scene).
/// Arrays may be borrowed (see Array): rendering reads them in place on the CPU device, and copies them on a Vulkan
/// device. Nothing of them is kept when render() returns.
struct Scene {
  std::string name;                   ///< for rows and messages
  std::uint32_t width = 1024;         ///< pixels, 1 to kMaxExtent
  std::uint32_t height = 1024;        ///< pixels, 1 to kMaxExtent
  Array<glm::vec3> positions;         ///< object space: the input's coordinates less `origin`
  Array<glm::vec4> clip;              ///< clip space, given as they are (replay files, tests): no transform runs
  Array<Triangle> triangles;          ///< triangle i has id i
  std::vector<Stream> streams;        ///< data of the vertices, by unique names
  Matrix clipFromObject = kIdentity;  ///< object space to clip space
  /// What loadInput() took from the input's coordinates before it rounded them; 0 for a scene near 0. A frame depends
  /// on positions and matrix alone.
  glm::dvec3 origin{0};
  std::vector<std::string> notes;  ///< one line each: what a user would not expect of the input
  bool unseen = false;  ///< the notes say why nothing can be seen of the whole scene or of one of its meshes

  /// How many positions there are, of whichever space.
  std::size_t vertexCount() const { return positions.empty() ? clip.size() : positions.size(); }
  /// Null where the scene has no stream of that name.
  const Stream* stream(std::string_view name) const {
    for (const Stream& s : streams)
      if (s.name == name) return &s;
    return nullptr;
  }
  /// The first stream that frames get a channel of; null where there is none.
  const Stream* attribute() const {
    for (const Stream& s : streams)
      if (s.interpolated) return &s;
    return nullptr;
  }
  /// The stream of that name, made where there is none. Throws kUsage where there is another of that name.
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

/// The streams that frames get a channel of, in the scene's order.
inline std::vector<const Stream*> interpolatedStreams(const Scene& scene) {
  std::vector<const Stream*> list;
  for (const Stream& stream : scene.streams)
    if (stream.interpolated) list.push_back(&stream);
  return list;
}

}  // namespace tessera
