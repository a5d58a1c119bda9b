// OFF: "OFF" with optional prefixes, the counts, then one vertex and one face a line (Geomview's object file format).
#include <fmt/format.h>

#include <iterator>

#include "datasets/checked.h"
#include "datasets/text.h"

namespace tessera {
namespace {

void copyWords(std::string& text, const Lines& lines, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) text.append(lines.words()[i]).push_back(i + 1 < count ? ' ' : '\n');
}

}  // namespace

Checked checkOff(const std::string& name, std::string_view text) {
  Checked checked;
  checked.text.reserve(text.size());
  Lines lines(name, text, Lines::Comments::kHash);
  lines.need("the word OFF");
  const std::string header(lines.words()[0]);
  // Prefixes: ST texture coordinates, C colours, N normals, all of which follow x y z on a vertex's line. 4 and n
  // change x y z.
  if (header != "OFF" && header != "COFF" && header != "NOFF" && header != "CNOFF" && header != "STOFF" &&
      header != "STCOFF" && header != "STNOFF" && header != "STCNOFF")
    lines.fail(fmt::format("'{}' where OFF, COFF, NOFF or STOFF would be right", header));
  std::size_t counts = 1;  // they follow on the same line, or on the next one
  if (lines.words().size() == 1) {
    lines.need("the counts of vertices and faces");
    counts = 0;
  }
  if (lines.words()[counts] == "BINARY")
    lines.fail("binary OFF is not read; OFF as text, or binary PLY, would be right");
  // Each takes a line of at least two bytes, so a count beyond the file's size is wrong; it also bounds what is set
  // aside.
  const auto most = static_cast<std::int64_t>(text.size());
  checked.vertices = static_cast<std::size_t>(lines.integer(counts, "count of vertices", 0, most));
  checked.faces = static_cast<std::size_t>(lines.integer(counts + 1, "count of faces", 0, most));
  fmt::format_to(std::back_inserter(checked.text), "OFF\n{} {} 0\n", checked.vertices, checked.faces);
  for (std::size_t i = 0; i < checked.vertices; ++i) {
    if (!lines.next()) lines.fail(fmt::format("the file ends after {} of {} vertices", i, checked.vertices));
    for (std::size_t k = 0; k < 3; ++k) lines.real(k, "vertex (x y z)");
    copyWords(checked.text, lines, 3);
  }
  for (std::size_t i = 0; i < checked.faces; ++i) {
    if (!lines.next()) lines.fail(fmt::format("the file ends after {} of {} faces", i, checked.faces));
    const auto corners = static_cast<std::size_t>(lines.integer(0, "count of corners", 0, most));
    for (std::size_t k = 1; k <= corners; ++k) lines.integer(k, "corner of a face", INT32_MIN, INT32_MAX);
    copyWords(checked.text, lines, corners + 1);
  }
  return checked;
}

}  // namespace tessera
