// INPUT of the command line to a Scene: a mesh file, a generator, a scene file or a replay file.
#pragma once

#include <tessera/framebuffer.h>
#include <tessera/scene.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tessera {

/// A value a vertex, by name: x, y or z of its position as the input has it (after the matrices of its meshes), or a
/// scalar property of the vertices of a PLY file. With a range an integer property i of 0 to 32767 becomes A + (B - A)
/// (i / 32767), in double precision and then rounded; of others it says nothing.
struct AttributeRequest {
  std::string name;  ///< empty: no attribute
  std::optional<ValueRange> range;  ///< A and B; absent: values stay as the file has them

  /// Whether the value is one of the position's coordinates.
  bool isCoordinate() const { return name == "x" || name == "y" || name == "z"; }
};

/// Called now and then while a mesh file is read, with the bytes that are behind and those of the whole file.
using ReadProgress = std::function<void(std::size_t done, std::size_t total)>;

/// A mesh file (.obj .off .ply .stl), an installed one (`mesh:NAME`, see installed-mesh.h),
/// `generate:NAME?key=value&...`, a scene (.toml) or a replay file (.replay). A lone mesh gets the camera of
/// frameCamera(). Throws kUsage with one line: file, place, what is wrong, what would be right. `width` and `height`
/// replace the scene's raster size (0: its own, 1024 for a lone mesh) and shape cameras, but for one given as a matrix.
/// A flat generator fills the clip volume by the identity matrix. Every mesh has to have the attribute. A scene that
/// lies far from 0 gets an origin (Scene::origin, extent.h); what a user would not expect is in its notes.
Scene loadInput(const std::string& input, std::uint32_t width = 0, std::uint32_t height = 0,
                const AttributeRequest& attribute = {}, const ReadProgress& progress = {});

/// What an index out of range becomes in a mesh: it stays out of range when meshes are joined.
inline constexpr std::uint32_t kBadIndex = 0xffffffffu;

/// Positions, triangles in the file's order (a polygon of n corners is n - 2 of them, a fan from its first corner where
/// it is convex), normals if the file has them, else computed (area-weighted vertex normals). Every face is kept.
/// Coordinates of binary files may be infinite or NaN.
struct Mesh {
  std::vector<glm::dvec3> positions;  ///< as the file has them: of text in double, of binary data in its type
  std::vector<glm::vec3> normals;     ///< one a position, of unit length
  std::vector<Triangle> triangles;    ///< three indices into `positions` each
  std::vector<Stream> streams;        ///< what was asked for, but for a coordinate, which the scene's are
  bool float32 = false;                 ///< the file's coordinates are float32: what made the file has rounded them
  std::vector<std::string> notes = {};  ///< what a user would not expect of this file: a line each, without its name
  std::uint64_t concavePolygons = 0;    ///< cut into triangles by ear clipping; the others are fans
};
/// Reads a mesh file: .obj, .off, .ply or .stl, by its extension. `attribute`: what becomes Mesh::attribute. Throws
/// kUsage with one line: file, place, what is wrong, what would be right.
Mesh readMesh(const std::filesystem::path& path, const AttributeRequest& attribute = {},
              const ReadProgress& progress = {});
/// Makes the mesh of a generator. `spec`: an input without its `generate:`, e.g. "icosphere?level=5". Throws kUsage for
/// an unknown generator or parameter, and for a value out of its range, naming what there is.
Mesh generateMesh(const std::string& spec);

/// One line a generator: name, parameters with defaults and ranges, what it makes; printed by the help and by
/// datasets/README.md.
struct GeneratorDoc {
  std::string name;        ///< e.g. "icosphere"
  std::string parameters;  ///< its parameters, with defaults and ranges
  std::string makes;       ///< the mesh that it makes, in words
};
/// All generators.
const std::vector<GeneratorDoc>& generatorDocs();

/// A perspective camera that sees all triangles of a scene from the front, a little above, as near as its sides allow.
/// Vertices that no triangle uses, and triangles that cannot be drawn, do not count.
Matrix frameCamera(const Scene& scene);
/// Appends a mesh to a scene that holds no clip positions (ids follow on): its positions, less the scene's origin,
/// rounded once.
void append(Scene& scene, const Mesh& mesh);

/// Writes a replay file, which is what parity leaves of a difference: clip-space positions (those of the contract's
/// transform where the scene has object-space ones), triangles and the attribute if there is one, bit for bit. A replay
/// file is text; replay.cpp describes it. Throws kFailure where the file cannot be written.
void writeReplay(const std::filesystem::path& path, const Scene& scene);
/// Reads a replay file. Throws kUsage with one line: file, line, what is wrong.
Scene readReplay(const std::filesystem::path& path);
/// SHA-256 (hex) of what defines the image, of any shading: size, matrix, positions or clip positions, normals,
/// triangles, and where there are some the attribute with its name and the origin. Not the scene's own name.
std::string sceneHash(const Scene& scene);

}  // namespace tessera
