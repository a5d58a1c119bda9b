#include <fmt/format.h>
#include <tessera/error.h>

#include "datasets/attribute.h"
#include "datasets/mesh-formats.h"
#include "datasets/normals.h"
#include "datasets/text.h"
#include "host/support/text.h"

namespace tessera {

namespace datasets {

Mesh readMeshAsItIs(const std::filesystem::path& path, const AttributeRequest& attribute,
                    const ReadProgress& progress) {
  const std::string name = path.string();
  const std::string extension = support::lowerCase(path.extension().string());
  const bool obj = extension == ".obj", off = extension == ".off", ply = extension == ".ply", stl = extension == ".stl";
  if (!obj && !off && !ply && !stl)
    failUsage(fmt::format("{}: unknown extension '{}'; .obj, .off, .ply or .stl would be right", name, extension));
  if (!attribute.name.empty() && !attribute.isCoordinate() && !ply) failAttribute(name, attribute.name, kCoordinates);
  InputFile in(path);
  if (stl) return readStl(in, progress);
  const FileBytes bytes(in);
  const FileText file{name, plainText(name, bytes.view()), progress};
  return obj ? readObj(file) : off ? readOff(file) : readPly(file, attribute);
}

}  // namespace datasets

Mesh readMesh(const std::filesystem::path& path, const AttributeRequest& attribute, const ReadProgress& progress) {
  Mesh mesh = datasets::readMeshAsItIs(path, attribute, progress);
  datasets::completeNormals(mesh);
  return mesh;
}

}  // namespace tessera
