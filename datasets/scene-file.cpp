#include "datasets/scene-file.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <optional>

#include "datasets/attribute.h"
#include "datasets/camera.h"
#include "datasets/text.h"
#include "datasets/toml-table.h"
#include "host/error.h"

namespace tessera {
namespace {

std::optional<Matrix> readMatrix(const TomlTable& table, std::string_view key) {
  const auto values = table.numbers(key, 16);
  if (!values) return std::nullopt;
  Matrix matrix;
  for (std::size_t i = 0; i < 16; ++i) {
    matrix[i] = static_cast<float>((*values)[i]);
    if (!std::isfinite(matrix[i]))
      table.refuse(key, *table.find(key), fmt::format("{} is beyond float32", (*values)[i]));
  }
  return matrix;
}

/// Positions: ((m0 x + m1 y) + m2 z) + m3, each component, float32. Normals by the inverse transpose.
void applyMatrix(Mesh& mesh, const Matrix& m) {
  const auto row = [&](std::size_t r, const glm::vec3& p) {
    return ((m[r] * p.x + m[r + 1] * p.y) + m[r + 2] * p.z) + m[r + 3];
  };
  for (glm::dvec3& position : mesh.positions) {
    const glm::vec3 p(position);
    position = {row(0, p), row(4, p), row(8, p)};
  }
  // The cofactor matrix: the inverse transpose times the determinant, there even where a matrix flattens. Its sign is
  // taken out, so that normals stay on their side under a reflection.
  const glm::dvec3 x(m[0], m[1], m[2]), y(m[4], m[5], m[6]), z(m[8], m[9], m[10]);
  const double sign = glm::dot(x, glm::cross(y, z)) < 0 ? -1 : 1;
  const glm::dvec3 cx = glm::cross(y, z) * sign, cy = glm::cross(z, x) * sign, cz = glm::cross(x, y) * sign;
  for (glm::vec3& normal : mesh.normals) {
    const glm::dvec3 n(normal), turned(glm::dot(cx, n), glm::dot(cy, n), glm::dot(cz, n));
    const double length = glm::length(turned);
    normal = length > 0 && std::isfinite(length) ? glm::vec3(turned / length) : glm::vec3(0, 0, 1);
  }
}

/// Appends the mesh of one [[mesh]]; true if it fills clip space as it is.
bool addMesh(Scene& scene, const std::string& file, const toml::table& table, const std::filesystem::path& folder,
             const AttributeRequest& attribute) {
  const TomlTable mesh(file, table, "[[mesh]]", {"source", "matrix"});
  const toml::node& source = mesh.need("source", "a path relative to this file, generate:NAME or mesh:NAME");
  const auto text = source.value<std::string>();
  if (!text) mesh.fail(source.source(), "source: a string would be right");
  const auto matrix = readMatrix(mesh, "matrix");
  if (matrix && !((*matrix)[12] == 0 && (*matrix)[13] == 0 && (*matrix)[14] == 0 && (*matrix)[15] == 1))
    mesh.fail(mesh.find("matrix")->source(), "matrix: a last row of 0, 0, 0, 1 would be right");
  Source loaded = [&]() -> Source {
    try {
      return loadSource(*text, folder, attribute);
    } catch (const Error& error) {
      mesh.fail(source.source(), error.what());
    }
  }();
  if (matrix) applyMatrix(loaded.mesh, *matrix);
  append(scene, loaded.mesh);
  return loaded.flat;
}

Matrix readCamera(const std::string& file, const toml::table& table, std::uint32_t width, std::uint32_t height) {
  const TomlTable camera(file, table, "[camera]", {"matrix", "eye", "target", "up", "fov", "near", "far"});
  if (const auto matrix = readMatrix(camera, "matrix")) {
    if (table.size() > 1)
      camera.fail(table.source(),
                  "[camera] has matrix and other keys; matrix alone, or eye and target, would be right");
    return *matrix;
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
  return perspective(result, width, height);
}

}  // namespace

Scene readSceneFile(const std::filesystem::path& path, std::uint32_t width, std::uint32_t height,
                    const AttributeRequest& attribute) {
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
  for (const toml::node& mesh : *meshes.as_array())
    flat &= addMesh(scene, file, *mesh.as_table(), path.parent_path(), attribute);
  setCoordinates(scene, attribute);
  if (const toml::node* const camera = top.find("camera")) {
    if (!camera->is_table()) top.fail(camera->source(), "camera: [camera] would be right");
    scene.clipFromObject = readCamera(file, *camera->as_table(), scene.width, scene.height);
  } else if (!flat) {
    scene.clipFromObject = frameCamera({{scene.positions.begin(), scene.positions.end()}, {}, {}, {}}, scene.width, scene.height);
  }
  return scene;
}

}  // namespace tessera
