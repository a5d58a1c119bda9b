// In front of OpenMesh's text readers. They take what they cannot read for zeros, for the value before, or for nothing
// at all, and leave out faces that name a corner twice: each would move the ids of what follows. So a file is checked
// first, line by line, and OpenMesh is given what it reads faithfully: the same vertices and faces, one a line, without
// comments, colours and materials.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "datasets/input.h"

namespace tessera {

/// A face that OpenMesh would leave out, with the number that it has among the file's faces.
struct WithheldFace {
  std::size_t face;
  std::vector<std::uint32_t> corners;
};

/// A number of a PLY file's vertices. Places are counted in words where the file is text, else in bytes.
struct PlyScalar {
  std::string name;
  std::string type;       ///< one of PLY's sixteen
  std::size_t place = 0;  ///< in a vertex
};
/// Where the vertices of a PLY file lie.
struct PlyVertices {
  bool text = true, bigEndian = false;
  std::size_t header = 0;              ///< bytes; the data follow
  std::size_t before = 0, stride = 0;  ///< what elements ahead of them take; one vertex
  std::vector<PlyScalar> scalars;
};

struct Checked {
  std::string text;                     ///< for OpenMesh
  std::size_t vertices = 0, faces = 0;  ///< in the file, the withheld faces among them
  std::vector<WithheldFace> withheld;   ///< in order
  PlyVertices ply;                      ///< of a PLY file
  bool wholeText = true;                ///< nothing but white space may be left when OpenMesh has read it
};

/// `name` is the file's, for messages. Each throws kUsage with "file:line: what is wrong".
Checked checkObj(const std::string& name, std::string_view text);
Checked checkOff(const std::string& name, std::string_view text);
Checked checkPly(const std::string& name, std::string_view text);

/// An attribute of the vertices of a file that checkPly() has seen and that has been read to its end.
std::vector<float> readPlyScalar(const std::string& name, std::string_view text, const Checked& checked,
                                 const AttributeRequest& attribute);

}  // namespace tessera
