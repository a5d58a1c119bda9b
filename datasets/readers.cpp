#include <fmt/format.h>

#include "datasets/attribute.h"
#include "datasets/mesh-formats.h"
#include "datasets/normals.h"
#include "datasets/text.h"
#include "host/error.h"

namespace tessera {

Mesh readMesh(const std::filesystem::path& path, const AttributeRequest& attribute, const ReadProgress& progress) {
  const std::string name = path.string();
  const std::string extension = lowerCase(path.extension().string());
  const bool obj = extension == ".obj", off = extension == ".off", ply = extension == ".ply", stl = extension == ".stl";
  if (!obj && !off && !ply && !stl)
    failUsage(fmt::format("{}: unknown extension '{}'; .obj, .off, .ply or .stl would be right", name, extension));
  if (!attribute.name.empty() && !attribute.isCoordinate() && !ply) failAttribute(name, attribute.name, kCoordinates);
  const FileBytes bytes(path);
  // Binary STL may begin with anything, and so its reader looks for a byte order mark itself.
  const FileText file{name, stl ? bytes.view() : plainText(name, bytes.view()), progress};
  Mesh mesh = obj ? readObj(file) : off ? readOff(file) : ply ? readPly(file, attribute) : readStl(file);
  completeNormals(mesh);
  return mesh;
}

}  // namespace tessera
