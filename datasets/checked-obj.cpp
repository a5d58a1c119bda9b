// Wavefront OBJ: the lines v, vn and f; the rest (texture coordinates, groups, materials, curves) says nothing about
// triangles.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "datasets/checked.h"
#include "datasets/input.h"
#include "datasets/text.h"

namespace tessera {
namespace {

/// One corner of a face, "position/texture/normal" with the last two left out or empty, as written.
struct Corner {
  std::int64_t position;
  std::string_view normal;
};

Corner parseCorner(const Lines& lines, std::string_view word) {
  const std::size_t slash = std::min(word.find('/'), word.size());
  const auto position = toInteger(word.substr(0, slash));
  if (!position) lines.fail(fmt::format("corner '{}' of a face does not begin with a whole number", word));
  const std::size_t second = word.find('/', slash + 1);
  const std::string_view normal =
      slash < word.size() && second != word.npos ? word.substr(second + 1) : std::string_view{};
  if (!normal.empty() && !toInteger(normal))
    lines.fail(fmt::format("corner '{}' of a face: the normal is not a whole number", word));
  return {*position, normal};
}

std::size_t countVertices(const std::string& name, std::string_view text) {
  Lines lines(name, text, Lines::Comments::kHash);
  lines.joinContinued();
  std::size_t count = 0;
  while (lines.next()) count += lines.words()[0] == "v";
  return count;
}

}  // namespace

Checked checkObj(const std::string& name, std::string_view text) {
  Checked checked;
  checked.text.reserve(text.size());
  auto out = std::back_inserter(checked.text);
  const auto total = static_cast<std::int64_t>(countVertices(name, text));  // a face may come before its vertices
  Lines lines(name, text, Lines::Comments::kHash);
  lines.joinContinued();
  std::vector<Corner> corners;
  std::vector<std::uint32_t> indices, sorted;
  while (lines.next()) {
    const auto& words = lines.words();
    if (words[0] == "v" || words[0] == "vn") {
      for (std::size_t i = 1; i <= 3; ++i) lines.real(i, words[0] == "v" ? "vertex (v x y z)" : "normal (vn x y z)");
      fmt::format_to(out, "{} {} {} {}\n", words[0], words[1], words[2], words[3]);
      checked.vertices += words[0] == "v";
    } else if (words[0] == "f") {
      if (words.size() < 4) lines.fail("a face has fewer than 3 corners");
      corners.clear();
      indices.clear();
      for (std::size_t i = 1; i < words.size(); ++i) {
        corners.push_back(parseCorner(lines, words[i]));
        // Counted from 1; from the last vertex so far, -1, where negative.
        std::int64_t& position = corners.back().position;
        if (position < 0) position += static_cast<std::int64_t>(checked.vertices) + 1;
        if (position < 1 || position > total) position = 0;
        indices.push_back(position == 0 ? kBadIndex : static_cast<std::uint32_t>(position - 1));
      }
      sorted = indices;
      std::ranges::sort(sorted);
      if (std::ranges::adjacent_find(sorted) != sorted.end()) {
        checked.withheld.push_back({checked.faces, indices});
      } else {
        checked.text += 'f';
        for (const auto& [position, normal] : corners)
          fmt::format_to(out, " {}{}{}", position, normal.empty() ? "" : "//", normal);
        checked.text += '\n';
      }
      ++checked.faces;
    }
  }
  if (checked.vertices == 0 && checked.faces == 0)
    lines.fail("no vertex (v x y z) and no face (f a b c) in the whole file");
  return checked;
}

}  // namespace tessera
