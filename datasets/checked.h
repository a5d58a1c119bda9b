// In front of OpenMesh's text readers. They take what they cannot read for zeros, for the value before, or for nothing
// at all, and leave out faces that name a corner twice: each would move the ids of what follows. So a file is checked
// first, line by line, and OpenMesh is given what it reads faithfully: the same vertices and faces, one a line, without
// comments, colours and materials.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tessera {

/// A face that OpenMesh would leave out, with the number that it has among the file's faces.
struct WithheldFace {
  std::size_t face;
  std::vector<std::uint32_t> corners;
};

struct Checked {
  std::string text;                     ///< for OpenMesh
  std::size_t vertices = 0, faces = 0;  ///< in the file, the withheld faces among them
  std::vector<WithheldFace> withheld;   ///< in order
  bool wholeText = true;                ///< nothing but white space may be left when OpenMesh has read it
};

/// `name` is the file's, for messages. Each throws kUsage with "file:line: what is wrong".
Checked checkObj(const std::string& name, std::string_view text);
Checked checkOff(const std::string& name, std::string_view text);
Checked checkPly(const std::string& name, std::string_view text);

}  // namespace tessera
