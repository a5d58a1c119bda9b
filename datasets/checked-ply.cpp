// PLY (Turk 1994): the header alone is checked; the data goes to OpenMesh as it is.
#include <fmt/format.h>

#include "datasets/checked.h"
#include "datasets/text.h"

namespace tessera {

Checked checkPly(const std::string& name, std::string_view text) {
  Checked checked;
  checked.text = text;
  // OpenMesh takes the end of the text right after the last number for a number cut off.
  checked.text += '\n';
  Lines lines(name, text);
  lines.need("the word ply");
  if (lines.words()[0] != "ply") lines.fail("'ply' would be right as the first line");
  std::string element;
  bool ended = false, corners = false;
  while (!ended) {
    lines.need("end_header");
    const auto& words = lines.words();
    if (words[0] == "element") {
      // OpenMesh stops after the faces: what follows them is nothing to it, or to us.
      if (element == "face") checked.wholeText = false;
      element = lines.word(1, "name of the element");
      const auto count = lines.integer(2, "count of the element", 0, static_cast<std::int64_t>(text.size()));
      if (element == "vertex") checked.vertices = static_cast<std::size_t>(count);
      if (element == "face") checked.faces = static_cast<std::size_t>(count);
    } else if (words[0] == "property" && lines.word(1, "type of the property") == "list" && checked.wholeText) {
      const std::string_view list = lines.word(4, "property list TYPE TYPE NAME");
      const bool isCorners = element == "face" && (list == "vertex_indices" || list == "vertex_index");
      // OpenMesh reads other lists as if they were single values, and everything after them from the wrong place.
      if (!isCorners)
        lines.fail(
            fmt::format("list '{}' of element '{}' cannot be read; a file without it would be right", list, element));
      corners = true;
    }
    ended = words[0] == "end_header";
  }
  if (checked.faces > 0 && !corners) lines.fail("element 'face' has no list 'vertex_indices'");
  return checked;
}

}  // namespace tessera
