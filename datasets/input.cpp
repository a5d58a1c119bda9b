#include <fmt/format.h>
#include <tessera/error.h>
#include <tessera/input.h>

#include "datasets/attribute.h"
#include "datasets/generators.h"
#include "datasets/installed-mesh.h"
#include "datasets/placing.h"
#include "datasets/scene-file.h"
#include "datasets/text.h"
#include "host/support/suggest.h"
#include "host/support/text.h"

namespace tessera {
namespace {

constexpr std::string_view kGenerate = "generate:";

/// The size that was asked for, or the input's own.
void setSize(Scene& scene, std::uint32_t width, std::uint32_t height) {
  if (width > kMaxExtent || height > kMaxExtent)
    failUsage(fmt::format("size {}x{}: 1x1 to {}x{} would be right", width, height, kMaxExtent, kMaxExtent));
  if (width != 0) scene.width = width;
  if (height != 0) scene.height = height;
}

}  // namespace

namespace datasets {

Source loadSource(const std::string& source, const std::filesystem::path& folder, const AttributeRequest& attribute,
                  const ReadProgress& progress) {
  if (source.starts_with(kInstalledMesh))
    return {readMesh(installedMesh(source.substr(kInstalledMesh.size())), attribute, progress), false};
  if (!source.starts_with(kGenerate)) return {readMesh(folder / source, attribute, progress), false};
  const std::string spec = source.substr(kGenerate.size());
  if (!attribute.name.empty() && !attribute.isCoordinate()) failAttribute(source, attribute.name, kCoordinates);
  return {generateMesh(spec), parseGenerator(spec).generator->flat};
}

}  // namespace datasets

Scene loadInput(const std::string& input, std::uint32_t width, std::uint32_t height, const AttributeRequest& attribute,
                const ReadProgress& progress) {
  const std::filesystem::path path = input;
  const bool generated = input.starts_with(kGenerate), installed = input.starts_with(datasets::kInstalledMesh);
  const std::string extension = generated || installed ? "" : support::lowerCase(path.extension().string());
  Scene scene;
  setSize(scene, width, height);
  if (extension == ".toml") return datasets::readSceneFile(path, width, height, attribute, progress);
  if (extension == ".replay") {
    scene = readReplay(path);
    setSize(scene, width, height);
    if (!attribute.name.empty() && scene.stream(attribute.name) == nullptr)
      datasets::failAttribute(input, attribute.name, support::namesOf(scene.streams, &Stream::name));
    return scene;
  }
  scene.name = generated   ? input.substr(kGenerate.size())
               : installed ? input.substr(datasets::kInstalledMesh.size())
                           : path.stem().string();
  datasets::Source source = datasets::loadSource(input, "", attribute, progress);
  std::vector<datasets::PlacedMesh> meshes;
  meshes.push_back({input, std::move(source.mesh), {}});
  datasets::placeMeshes(scene, std::move(meshes), attribute);
  scene.clipFromObject = source.flat ? kIdentity : frameCamera(scene);
  return scene;
}

void append(Scene& scene, const Mesh& mesh) {
  std::vector<glm::vec3> positions;
  positions.reserve(mesh.positions.size());
  for (const glm::dvec3& p : mesh.positions) positions.emplace_back(p - scene.origin);
  datasets::appendPlaced(scene, mesh, positions);
}

/// Normals of vertices without one: (0, 0, 1), up to so many.
static void fillNormals(std::vector<float>& normals, std::size_t vertices) {
  normals.reserve(3 * vertices);
  while (normals.size() < 3 * vertices) normals.insert(normals.end(), {0.0f, 0.0f, 1.0f});
}

namespace datasets {

void appendPlaced(Scene& scene, const Mesh& mesh, const std::vector<glm::vec3>& positions) {
  if (!scene.clip.empty()) fail("a mesh cannot be appended to a scene of clip-space positions");
  const std::size_t first = scene.positions.size(), count = positions.size();
  if (first + count >= kBadIndex || scene.triangles.size() + mesh.triangles.size() >= kBadIndex)
    failUsage(fmt::format("{} vertices and {} triangles: ids and indices reach to {}", first + count,
                          scene.triangles.size() + mesh.triangles.size(), kBadIndex - 1));
  std::vector<glm::vec3>& all = scene.positions.own();
  all.insert(all.end(), positions.begin(), positions.end());
  if (scene.stream(kNormals) != nullptr || !mesh.normals.empty()) {
    std::vector<float>& normals = scene.makeStream(kNormals, 3, false).values.own();
    fillNormals(normals, first);
    if (const auto* floats = reinterpret_cast<const float*>(mesh.normals.data()))
      normals.insert(normals.end(), floats, floats + 3 * mesh.normals.size());
    fillNormals(normals, first + count);
  }
  for (const Stream& stream : mesh.streams) {
    std::vector<float>& values = scene.makeStream(stream.name, stream.components, stream.interpolated).values.own();
    values.resize(first * stream.components, 0.0f);  // meshes before that have no such stream
    values.insert(values.end(), stream.values.begin(), stream.values.end());
  }
  scene.triangles.reserve(scene.triangles.size() + mesh.triangles.size());
  for (Triangle t : mesh.triangles) {
    // An index out of range must not reach the vertices of a mesh that comes later.
    for (std::uint32_t& v : t) v = v < count ? v + static_cast<std::uint32_t>(first) : kBadIndex;
    scene.triangles.push_back(t);
  }
}

}  // namespace datasets

}  // namespace tessera
