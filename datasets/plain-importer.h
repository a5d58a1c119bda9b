// What OpenMesh's readers fill: plain vertices and faces, as they come. The half-edge mesh that OpenMesh's own importer
// fills cannot hold faces that make it non-manifold, and renumbers what it splits.
#pragma once

#include <OpenMesh/Core/IO/importer/BaseImporter.hh>
#include <map>
#include <vector>

#include "datasets/checked.h"
#include "datasets/input.h"

namespace tessera {

/// Fans polygons from their first corner, puts withheld faces back in their places, and gives a vertex a twin where a
/// face asks for it with another normal (OBJ numbers normals apart from positions).
class PlainImporter final : public OpenMesh::IO::BaseImporter {
 public:
  explicit PlainImporter(const Checked& checked);
  /// The mesh, with the zero vector where the file gave a vertex no normal.
  Mesh take();

  OpenMesh::VertexHandle add_vertex(const OpenMesh::Vec3f& point) override;
  OpenMesh::VertexHandle add_vertex() override { return add_vertex(OpenMesh::Vec3f(0, 0, 0)); }
  void set_point(OpenMesh::VertexHandle vertex, const OpenMesh::Vec3f& point) override;
  OpenMesh::FaceHandle add_face(const VHandles& corners) override;
  void set_normal(OpenMesh::VertexHandle vertex, const OpenMesh::Vec3f& normal) override;
  void set_normal(OpenMesh::VertexHandle v, const OpenMesh::Vec3d& n) override { set_normal(v, OpenMesh::Vec3f(n)); }
  std::size_t n_vertices() const override { return vertices_; }
  std::size_t n_faces() const override { return faces_; }
  std::size_t n_edges() const override { return 0; }

  // The rest of the interface belongs to the half-edge mesh, or says nothing about triangles.
  using Halfedge = OpenMesh::HalfedgeHandle;
  using Edge = OpenMesh::EdgeHandle;
  using Vertex = OpenMesh::VertexHandle;
  using Face = OpenMesh::FaceHandle;
  using Status = OpenMesh::Attributes::StatusInfo;
  Halfedge add_edge(Vertex, Vertex) override { return Halfedge(); }
  Face add_face(Halfedge) override { return Face(); }
  void add_face_texcoords(Face, Vertex, const std::vector<OpenMesh::Vec2f>&) override {}
  void add_face_texcoords(Face, Vertex, const std::vector<OpenMesh::Vec3f>&) override {}
  void set_face_texindex(Face, int) override {}
  void set_halfedge(Vertex, Halfedge) override {}
  void set_next(Halfedge, Halfedge) override {}
  void set_face(Halfedge, Face) override {}
  void request_face_texcoords2D() override {}
  void add_texture_information(int, std::string) override {}
  void set_texcoord(Vertex, const OpenMesh::Vec2f&) override {}
  void set_texcoord(Vertex, const OpenMesh::Vec3f&) override {}
  void set_texcoord(Halfedge, const OpenMesh::Vec2f&) override {}
  void set_texcoord(Halfedge, const OpenMesh::Vec3f&) override {}
  void set_status(Vertex, const Status&) override {}
  void set_status(Halfedge, const Status&) override {}
  void set_status(Edge, const Status&) override {}
  void set_status(Face, const Status&) override {}
  void set_normal(Face, const OpenMesh::Vec3f&) override {}
  void set_normal(Face, const OpenMesh::Vec3d&) override {}
  void set_color(Vertex, const OpenMesh::Vec3uc&) override {}
  void set_color(Vertex, const OpenMesh::Vec4uc&) override {}
  void set_color(Vertex, const OpenMesh::Vec3f&) override {}
  void set_color(Vertex, const OpenMesh::Vec4f&) override {}
  void set_color(Edge, const OpenMesh::Vec3uc&) override {}
  void set_color(Edge, const OpenMesh::Vec4uc&) override {}
  void set_color(Edge, const OpenMesh::Vec3f&) override {}
  void set_color(Edge, const OpenMesh::Vec4f&) override {}
  void set_color(Face, const OpenMesh::Vec3uc&) override {}
  void set_color(Face, const OpenMesh::Vec4uc&) override {}
  void set_color(Face, const OpenMesh::Vec3f&) override {}
  void set_color(Face, const OpenMesh::Vec4f&) override {}

 private:
  void putBack();
  void addPolygon(const std::vector<std::uint32_t>& corners);

  const Checked& checked_;
  Mesh mesh_;
  std::size_t vertices_ = 0;                                     ///< of the file; twins follow them
  std::size_t faces_ = 0;                                        ///< of the file so far, withheld ones among them
  std::size_t putBack_ = 0;                                      ///< withheld faces that are in
  std::map<std::array<std::uint32_t, 4>, std::uint32_t> twins_;  ///< vertex and bits of the normal -> vertex
  std::map<std::uint32_t, std::uint32_t> twinOfFace_;            ///< for the face that comes next: vertex -> twin
  std::vector<std::uint32_t> corners_;
};

}  // namespace tessera
