// Makes a Scene from the command line's INPUT: a mesh file, a generator, a scene file or a replay file.
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

/// A request for one value for each vertex, by name. The value is x, y or z of the vertex' position as the input has
/// the position (after the matrices of the input's meshes), or a scalar property of the vertices of a PLY file. With a
/// range from A to B, an integer property i of 0 to 32767 becomes, in double precision and then rounded,
///
///     A + (B - A) (i / 32767)
///
/// Other values stay as the file has them, with or without a range.
struct AttributeRequest {
  std::string name;                 ///< empty: no attribute
  std::optional<ValueRange> range;  ///< A and B; where it is absent, values stay as the file has them

  /// Whether the value is one of the position's coordinates.
  bool isCoordinate() const { return name == "x" || name == "y" || name == "z"; }
};

/// Called now and then while a mesh file is read, with the number of bytes that are read and the size of the file.
using ReadProgress = std::function<void(std::size_t done, std::size_t total)>;

/// Makes a scene from a mesh file (.obj .off .ply .stl), an installed mesh (`mesh:NAME`, see installed-mesh.h), a
/// generator (`generate:NAME?key=value&...`), a scene file (.toml) or a replay file (.replay). A lone mesh gets the
/// camera of frameCamera(). A flat generator fills the clip volume by the identity matrix. `width` and `height` replace
/// the scene's raster size, and give cameras their aspect, but for a camera that is given as a matrix. A `width` or
/// `height` of 0 stands for the scene's own, which is 1024 for a lone mesh. Every mesh has to have the attribute. A
/// scene that lies far from 0 gets an origin (Scene::origin, extent.h). The scene's notes say what a user would not
/// expect. Throws kUsage with one line: file, place, what is wrong, what would be right.
Scene loadInput(const std::string& input, std::uint32_t width = 0, std::uint32_t height = 0,
                const AttributeRequest& attribute = {}, const ReadProgress& progress = {});

/// An index out of range becomes this index in a mesh, so that the index stays out of range when meshes are joined.
inline constexpr std::uint32_t kBadIndex = 0xffffffffu;

/// What a mesh file holds. Every face is kept, and triangles keep the file's order. A polygon of n corners becomes
/// n - 2 triangles. Where the polygon is convex, the triangles are a fan from its first corner. Normals are the file's.
/// Where the file has no normals, they are computed (area-weighted vertex normals). Coordinates of binary files may be
/// infinite or NaN.
struct Mesh {
  std::vector<glm::dvec3> positions;    ///< as the file has them: text is read in double, binary data in its own type
  std::vector<glm::vec3> normals;       ///< one for each position, of unit length
  std::vector<Triangle> triangles;      ///< each has three indices into `positions`
  std::vector<Stream> streams;          ///< the attribute asked for; empty where it is a coordinate: the scene adds it
  bool float32 = false;                 ///< whether the file has float32 coordinates, which its maker has rounded
  std::vector<std::string> notes = {};  ///< what a user would not expect, a line for each fact, without the file's name
  std::uint64_t concavePolygons = 0;    ///< how many polygons ear clipping cut into triangles; the others are fans
};
/// Reads a mesh file: .obj, .off, .ply or .stl, by its extension. `attribute` asks for a stream of Mesh::streams.
/// Throws kUsage with one line: file, place, what is wrong, what would be right.
Mesh readMesh(const std::filesystem::path& path, const AttributeRequest& attribute = {},
              const ReadProgress& progress = {});
/// Makes the mesh of a generator. `spec` is an input without its `generate:`, e.g. "icosphere?level=5". Throws kUsage
/// for an unknown generator or parameter, and for a value out of its range. The message says what is there.
Mesh generateMesh(const std::string& spec);

/// The line on one generator in the help and in datasets/README.md.
struct GeneratorDoc {
  std::string name;        ///< e.g. "icosphere"
  std::string parameters;  ///< its parameters, with defaults and ranges
  std::string makes;       ///< the mesh that it makes, in words
};
/// All generators.
const std::vector<GeneratorDoc>& generatorDocs();

/// A perspective camera that sees all triangles of a scene from the front and a little above. The camera is as near as
/// its sides allow. Vertices that no triangle uses, and triangles that cannot be drawn, do not count.
Matrix frameCamera(const Scene& scene);
/// Appends a mesh to a scene that holds no clip positions. The mesh's ids follow the scene's. The mesh's positions,
/// less the scene's origin, are rounded once.
void append(Scene& scene, const Mesh& mesh);

/// Writes a replay file, which is what parity leaves of a difference. The file holds clip-space positions, triangles,
/// and the attribute if the scene has one, bit for bit. Where the scene has object-space positions, the contract's
/// transform gives the clip-space positions. A replay file is text; replay.cpp describes the format. Throws kFailure
/// where the file cannot be written.
void writeReplay(const std::filesystem::path& path, const Scene& scene);
/// Reads a replay file. Throws kUsage with one line: file, line, what is wrong.
Scene readReplay(const std::filesystem::path& path);
/// SHA-256 (hex) of what defines the image under any shading: size, matrix, positions or clip positions, normals and
/// triangles, and also the attribute with its name, and the origin, where the scene has them. The scene's own name does
/// not count.
std::string sceneHash(const Scene& scene);

}  // namespace tessera
