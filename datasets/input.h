// INPUT of the command line to a Scene: a mesh file, a generator, a scene file or a replay file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "host/scene.h"

namespace tessera {

/// A mesh that OpenMesh reads (.obj .off .ply .stl), `generate:NAME?key=value&...`, a scene (.toml) or a replay file
/// (.replay). A lone mesh gets the camera of frameCamera(). Throws kUsage with one line: file, place, what is wrong,
/// what would be right. `width` and `height` replace the scene's raster size (0: its own, 1024 for a lone mesh) and
/// shape cameras, but for one given as a matrix. A flat generator fills the clip volume by the identity matrix.
Scene loadInput(const std::string& input, std::uint32_t width = 0, std::uint32_t height = 0);

/// Positions, triangles in the file's order (polygons fanned from their first corner), normals if the file has them,
/// else computed (area-weighted vertex normals). Every face is kept: OpenMesh's half-edge mesh is not used for reading.
/// An index out of range becomes kBadIndex, which stays out of range when meshes are joined. Coordinates of binary
/// files may be infinite or NaN.
inline constexpr std::uint32_t kBadIndex = 0xffffffffu;
struct Mesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<Triangle> triangles;
};
Mesh readMesh(const std::filesystem::path& path);
/// `spec` without the `generate:` prefix, e.g. "icosphere?level=5".
Mesh generateMesh(const std::string& spec);

/// One line a generator: name, parameters with defaults and ranges, what it makes; printed by the help and by
/// datasets/README.md.
struct GeneratorDoc {
  std::string name, parameters, makes;
};
const std::vector<GeneratorDoc>& generatorDocs();

/// A perspective camera that sees the whole mesh from the front, a little above, as near as its sides allow.
Matrix frameCamera(const Mesh& mesh, std::uint32_t width, std::uint32_t height);
/// Appends a mesh to a scene that holds no clip positions (ids follow on).
void append(Scene& scene, const Mesh& mesh);

/// Clip-space positions (of the contract's transform, where the scene has object space ones) and triangles, bit-exact:
/// what parity writes on a difference, and tests read. A replay file is text: see replay.cpp.
void writeReplay(const std::filesystem::path& path, const Scene& scene);
Scene readReplay(const std::filesystem::path& path);
/// SHA-256 (hex) of what defines the image: size, matrix, positions or clip positions, triangles.
std::string sceneHash(const Scene& scene);

}  // namespace tessera
