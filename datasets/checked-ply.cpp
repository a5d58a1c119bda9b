// PLY (Turk 1994): the header is checked, strictly, since OpenMesh trusts it; the data goes to OpenMesh as it is.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "datasets/checked.h"
#include "datasets/ply-scalar.h"
#include "datasets/text.h"

namespace tessera {
namespace {

using Words = std::vector<std::string_view>;

void checkFormat(const Lines& lines) {
  const Words& words = lines.words();
  const bool known = words.size() == 3 &&
                     (words[1] == "ascii" || words[1] == "binary_little_endian" || words[1] == "binary_big_endian");
  if (words[0] != "format" || !known || words[2] != "1.0")
    lines.fail("format ascii, binary_little_endian or binary_big_endian, and 1.0, would be right");
}

/// Its bytes.
std::size_t checkType(const Lines& lines, std::string_view type) {
  const std::size_t bytes = plyTypeBytes(type);
  if (bytes == 0) lines.fail(fmt::format("'{}' is not a type of PLY", type));
  return bytes;
}

}  // namespace

Checked checkPly(const std::string& name, std::string_view text) {
  Checked checked;
  checked.text = text;
  // OpenMesh takes the end of the text right after the last number for a number cut off.
  checked.text += '\n';
  Lines lines(name, text, Lines::Comments::kNone);
  lines.need("the word ply");
  if (lines.words() != Words{"ply"}) lines.fail("'ply' would be right as the first line");
  lines.need("the format");
  while (lines.words()[0] == "comment" || lines.words()[0] == "obj_info") lines.need("the format");
  checkFormat(lines);
  PlyVertices& ply = checked.ply;
  ply.text = lines.words()[1] == "ascii";
  ply.bigEndian = lines.words()[1] == "binary_big_endian";
  std::size_t count = 0;  // of the element
  bool pastVertices = false;
  std::string element;
  bool hasCorners = false;
  std::set<std::string, std::less<>> elements, properties;  // of the file; of the element
  while (lines.need("end_header"), lines.words() != Words{"end_header"}) {
    const Words& words = lines.words();
    if (words[0] == "comment" || words[0] == "obj_info") continue;
    if (words[0] == "element" && words.size() == 3) {
      // OpenMesh stops after the faces: what follows them is nothing to it, or to us.
      if (element == "face") checked.wholeText = false;
      element = words[1];
      properties.clear();
      if (!elements.insert(element).second) lines.fail(fmt::format("element '{}' is there twice", element));
      count =
          static_cast<std::size_t>(lines.integer(2, "count of the element", 0, static_cast<std::int64_t>(text.size())));
      pastVertices |= elements.contains("vertex") && element != "vertex";
      if (element == "vertex") checked.vertices = count;
      if (element == "face") checked.faces = count;
      continue;
    }
    const bool list = words.size() == 5 && words[1] == "list";
    if (words[0] != "property" || element.empty() || (words.size() != 3 && !list))
      lines.fail("element NAME COUNT, and then property TYPE NAME or property list TYPE TYPE NAME, would be right");
    const std::string_view property = words.back();
    if (!properties.insert(std::string(property)).second)
      lines.fail(fmt::format("property '{}' is there twice", property));
    std::size_t size = 1;
    for (std::size_t i = list ? 2 : 1; i + 1 < words.size(); ++i)
      if (const std::size_t bytes = checkType(lines, words[i]); !ply.text) size = bytes;
    if (element == "vertex") {
      ply.scalars.push_back({std::string(property), std::string(words[1]), ply.stride});
      ply.stride += size;
    } else if (!pastVertices) {
      ply.before += count * size;
    }
    const bool corners = property == "vertex_indices" || property == "vertex_index";
    // OpenMesh reads other lists as if they were single values, and everything after them from the wrong place.
    if (list && checked.wholeText && !(element == "face" && corners))
      lines.fail(
          fmt::format("list '{}' of element '{}' cannot be read; a file without it would be right", property, element));
    if (!list && element == "face" && corners) lines.fail(fmt::format("'{}' is not a list", property));
    constexpr std::string_view kReals = " x y z nx ny nz ";
    if (element == "vertex" && kReals.find(fmt::format(" {} ", property)) != kReals.npos && words[1][0] != 'f' &&
        words[1][0] != 'd')
      lines.fail(fmt::format("'{}' of a vertex is {}; float or double would be right", property, words[1]));
    if (element == "face" && corners && std::exchange(hasCorners, true)) lines.fail("two lists of corners");
  }
  ply.header = lines.at();
  if (checked.faces > 0 && !hasCorners) lines.fail("element 'face' has no list 'vertex_indices'");
  return checked;
}

}  // namespace tessera
