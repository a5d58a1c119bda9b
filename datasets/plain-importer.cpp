#include "datasets/plain-importer.h"

#include <bit>

namespace tessera {

using OpenMesh::FaceHandle;
using OpenMesh::Vec3f;
using OpenMesh::VertexHandle;

PlainImporter::PlainImporter(const Checked& checked) : checked_(checked) {
  mesh_.positions.reserve(checked.vertices);
  mesh_.triangles.reserve(checked.faces);
}

VertexHandle PlainImporter::add_vertex(const Vec3f& point) {
  mesh_.positions.emplace_back(point[0], point[1], point[2]);
  return VertexHandle(static_cast<int>(vertices_++));
}

void PlainImporter::set_point(VertexHandle vertex, const Vec3f& point) {
  mesh_.positions.at(static_cast<std::size_t>(vertex.idx())) = {point[0], point[1], point[2]};
}

void PlainImporter::set_normal(VertexHandle handle, const Vec3f& n) {
  const auto vertex = static_cast<std::uint32_t>(handle.idx());
  if (vertex >= vertices_) return;
  mesh_.normals.resize(mesh_.positions.size(), glm::vec3(0));
  const glm::vec3 normal(n[0], n[1], n[2]);
  glm::vec3& own = mesh_.normals[vertex];
  if (own == glm::vec3(0)) own = normal;
  if (own == normal) return;
  const std::array key{vertex, std::bit_cast<std::uint32_t>(n[0]), std::bit_cast<std::uint32_t>(n[1]),
                       std::bit_cast<std::uint32_t>(n[2])};
  const auto [twin, isNew] = twins_.try_emplace(key, static_cast<std::uint32_t>(mesh_.positions.size()));
  if (isNew) {
    mesh_.positions.push_back(mesh_.positions[vertex]);
    mesh_.normals.push_back(normal);
  }
  twinOfFace_[vertex] = twin->second;
}

FaceHandle PlainImporter::add_face(const VHandles& handles) {
  putBack();
  corners_.clear();
  for (const VertexHandle handle : handles) {
    auto vertex = static_cast<std::uint32_t>(handle.idx());
    if (vertex >= checked_.vertices) vertex = kBadIndex;  // or a twin could come to lie there
    const auto twin = twinOfFace_.find(vertex);
    corners_.push_back(twin == twinOfFace_.end() ? vertex : twin->second);
  }
  twinOfFace_.clear();
  addPolygon(corners_);
  return FaceHandle(static_cast<int>(faces_ - 1));
}

void PlainImporter::addPolygon(const std::vector<std::uint32_t>& corners) {
  for (std::size_t i = 2; i < corners.size(); ++i) mesh_.triangles.push_back({corners[0], corners[i - 1], corners[i]});
  ++faces_;
}

void PlainImporter::putBack() {
  const auto& withheld = checked_.withheld;
  while (putBack_ < withheld.size() && withheld[putBack_].face == faces_) addPolygon(withheld[putBack_++].corners);
}

Mesh PlainImporter::take() {
  putBack();
  if (!mesh_.normals.empty()) mesh_.normals.resize(mesh_.positions.size(), glm::vec3(0));
  return std::move(mesh_);
}

}  // namespace tessera
