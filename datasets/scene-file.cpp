#include "datasets/scene-file.h"

#include <fmt/format.h>
#include <tessera/error.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "datasets/camera.h"
#include "datasets/notes.h"
#include "datasets/placing.h"
#include "datasets/text.h"
#include "datasets/toml-table.h"

namespace tessera::datasets {
namespace {

constexpr support::DoubleMatrix kNoCamera{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

std::optional<support::DoubleMatrix> readMatrix(const TomlTable& table, std::string_view key) {
  const auto values = table.numbers(key, 16);
  if (!values) return std::nullopt;
  support::DoubleMatrix matrix;
  for (std::size_t i = 0; i < 16; ++i) {
    matrix[i] = (*values)[i];
    if (!std::isfinite(static_cast<float>(matrix[i])))
      table.refuse(key, *table.find(key), fmt::format("{} is beyond float32", matrix[i]));
  }
  return matrix;
}

/// The mesh of one [[mesh]]; `flat` becomes false if it does not fill clip space as it is.
PlacedMesh readPlaced(const std::string& file, const toml::table& table, const std::filesystem::path& folder,
                      const AttributeRequest& attribute, const ReadProgress& progress, bool& flat) {
  const TomlTable mesh(file, table, "[[mesh]]", {"source", "matrix"});
  const toml::node& source = mesh.need("source", "a path relative to this file, generate:NAME or mesh:NAME");
  const auto text = source.value<std::string>();
  if (!text) mesh.fail(source.source(), "source: a string would be right");
  const auto matrix = readMatrix(mesh, "matrix");
  if (matrix && !((*matrix)[12] == 0 && (*matrix)[13] == 0 && (*matrix)[14] == 0 && (*matrix)[15] == 1))
    mesh.fail(mesh.find("matrix")->source(), "matrix: a last row of 0, 0, 0, 1 would be right");
  try {
    Source loaded = loadSource(*text, folder, attribute, progress);
    flat &= loaded.flat;
    return {fmt::format("{}: {}", file, *text), std::move(loaded.mesh), matrix};
  } catch (const Error& error) {
    mesh.fail(source.source(), error.what());
  }
}

/// For the scene's positions, which begin at its origin.
Matrix readCamera(const std::string& file, const toml::table& table, const Scene& scene) {
  const TomlTable camera(file, table, "[camera]", {"matrix", "eye", "target", "up", "fov", "near", "far"});
  if (const auto matrix = readMatrix(camera, "matrix")) {
    if (table.size() > 1)
      camera.fail(table.source(),
                  "[camera] has matrix and other keys; matrix alone, or eye and target, would be right");
    const Matrix moved = clipFromPositions(*matrix, scene.origin);
    if (!std::ranges::all_of(moved, [](float m) { return std::isfinite(m); }))
      camera.refuse("matrix", *table.get("matrix"), "where the scene is, it goes beyond float32");
    return moved;
  }
  camera.need("eye", "a matrix, or eye and target, would be right");
  camera.need("target", "a matrix, or eye and target, would be right");
  const auto vector = [&](std::string_view key, const glm::dvec3& otherwise) {
    const auto values = camera.numbers(key, 3);
    return values ? glm::dvec3((*values)[0], (*values)[1], (*values)[2]) : otherwise;
  };
  Camera result;
  result.eye = vector("eye", {});
  result.target = vector("target", {});
  result.up = vector("up", result.up);
  result.fov = camera.number("fov").value_or(result.fov);
  result.near = camera.number("near").value_or(result.near);
  result.far = camera.number("far").value_or(result.far);
  const glm::dvec3 forward = result.target - result.eye, side = glm::cross(forward, result.up);
  if (!(result.fov > 0 && result.fov < 180))
    camera.fail(table.source(), fmt::format("fov {}: between 0 and 180 degrees would be right", result.fov));
  if (!(result.near > 0 && result.far > result.near))
    camera.fail(table.source(),
                fmt::format("near {} and far {}: 0 < near < far would be right", result.near, result.far));
  if (!(glm::dot(forward, forward) > 0)) camera.fail(table.source(), "eye and target are one point");
  if (!(glm::dot(side, side) > 0)) camera.fail(table.source(), "up lies along the line of sight");
  result.eye -= scene.origin;
  result.target -= scene.origin;
  return perspective(result, scene.width, scene.height);
}

}  // namespace

Scene readSceneFile(const std::filesystem::path& path, std::uint32_t width, std::uint32_t height,
                    const AttributeRequest& attribute, const ReadProgress& progress) {
  const std::string file = path.string();
  const toml::table root = parseToml(file, readFile(path));
  const TomlTable top(file, root, "a scene", {"size", "mesh", "camera"});
  Scene scene;
  scene.name = path.stem().string();
  if (const auto size = top.numbers("size", 2)) {
    const auto extent = [&](double value) {
      if (!(value >= 1 && value <= kMaxExtent && value == std::floor(value)))
        top.fail(top.find("size")->source(),
                 fmt::format("size: {} is not a whole number from 1 to {}", value, kMaxExtent));
      return static_cast<std::uint32_t>(value);
    };
    scene.width = extent((*size)[0]);
    scene.height = extent((*size)[1]);
  }
  if (width != 0) scene.width = width;
  if (height != 0) scene.height = height;

  const toml::node& meshes = top.need("mesh", "at least one [[mesh]] would be right");
  if (!meshes.is_array_of_tables()) top.fail(meshes.source(), "mesh: [[mesh]] would be right");
  bool flat = true;
  std::vector<PlacedMesh> placed;
  for (const toml::node& mesh : *meshes.as_array())
    placed.push_back(readPlaced(file, *mesh.as_table(), path.parent_path(), attribute, progress, flat));
  placeMeshes(scene, std::move(placed), attribute);
  if (const toml::node* const camera = top.find("camera")) {
    if (!camera->is_table()) top.fail(camera->source(), "camera: [camera] would be right");
    scene.clipFromObject = readCamera(file, *camera->as_table(), scene);
  } else {
    scene.clipFromObject = flat ? clipFromPositions(kNoCamera, scene.origin) : frameCamera(scene);
  }
  if (flat || top.has("camera")) noteUnseen(scene, file);
  return scene;
}

}  // namespace tessera::datasets
