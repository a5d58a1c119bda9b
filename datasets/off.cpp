// OFF: "OFF" with prefixes, the counts, then vertices and faces (Geomview's object file format).
#include <fmt/format.h>
#include <tessera/error.h>

#include <algorithm>

#include "datasets/faces.h"
#include "datasets/huge-pages.h"
#include "datasets/mesh-formats.h"
#include "datasets/text.h"

namespace tessera::datasets {
namespace {

struct Header {
  std::size_t begin = 0;  ///< of what follows the count of faces
  std::size_t vertices = 0, faces = 0;
  std::size_t coordinates = 0;  ///< numbers that follow x y z without a colour: a normal, texture coordinates
  bool colours = false;         ///< and then four
};

/// Reads "OFF" and its prefixes; the counts may follow in the same word, as in many files of ModelNet40.
void readKeyword(Scanner& in, Header& header) {
  in.needAhead("the word OFF");
  const std::size_t begin = in.at();
  const std::string_view word = in.word();
  std::string_view prefix = word.substr(0, word.find("OFF"));
  const auto take = [&](std::string_view text) {
    const bool there = prefix.starts_with(text);
    if (there) prefix.remove_prefix(text.size());
    return there;
  };
  header.coordinates = take("ST") ? 2 : 0;
  header.colours = take("C");
  header.coordinates += take("N") ? 3 : 0;
  const std::size_t end = word.find("OFF") + 3;
  const std::string_view count = word.size() >= end ? word.substr(end) : std::string_view{};
  const bool digits = std::ranges::all_of(count, [](char c) { return c >= '0' && c <= '9'; });
  if (word.find("OFF") != word.npos && digits && !prefix.empty() && prefix.find_first_not_of("4n") == prefix.npos)
    in.fail(fmt::format("{}: vertices of four or n coordinates are not read; OFF with x, y and z would be right",
                        shown(word)));
  if (word.find("OFF") == word.npos || !digits || !prefix.empty())
    in.fail(fmt::format("{} where OFF, COFF, NOFF or STOFF would be right", shown(word)));
  in.moveTo(begin + end);
}

Header readHeader(const FileText& file) {
  Scanner in(file, Scanner::Syntax::kHash);
  Header header;
  readKeyword(in, header);
  in.needAhead("the counts of vertices and faces");
  const std::size_t at = in.at();
  if (in.word() == "BINARY") in.fail("binary OFF is not read; OFF as text, or binary PLY, would be right");
  in.moveTo(at);
  // A vertex takes at least six bytes and a face two, so a count beyond the file's size is wrong; it also bounds what
  // is set aside.
  const auto most = static_cast<std::int64_t>(file.text.size());
  header.vertices = static_cast<std::size_t>(in.integer("count of vertices", 0, most));
  in.needAhead("the count of faces");
  header.faces = static_cast<std::size_t>(in.integer("count of faces", 0, most));
  header.begin = in.at();
  return header;
}

/// Colours are optional and end with their line, so that what follows on a line is a colour or the next vertex or face.
class Body {
 public:
  Body(const FileText& file, const Header& header, bool recordsEndLines)
      : in_(file, Scanner::Syntax::kHash), header_(header), recordsEndLines_(recordsEndLines) {
    in_.moveTo(header.begin);
    // The count of edges says nothing, and some files leave it out.
    if (recordsEndLines ? in_.more() : in_.ahead()) in_.integer("count of edges");
  }

  Mesh read() {
    reserveHuge(mesh_.positions, header_.vertices);
    for (std::size_t v = 0; v < header_.vertices; ++v) readVertex(v);
    reserveHuge(mesh_.triangles, header_.faces);
    for (std::size_t f = 0; f < header_.faces; ++f) readFace(f);
    if (in_.ahead())
      in_.fail(fmt::format("{} after the last of {} vertices and {} faces: the counts are wrong", shown(in_.word()),
                           header_.vertices, header_.faces));
    faces_.finish();
    return std::move(mesh_);
  }
  std::size_t at() const { return in_.at(); }

 private:
  void readVertex(std::size_t v) {
    if (!in_.ahead()) in_.fail(fmt::format("the file ends after {} of {} vertices", v, header_.vertices));
    glm::dvec3 p;
    for (int axis = 0; axis < 3; ++axis) {
      need("vertex (x y z)");
      p[axis] = in_.real("vertex (x y z)");
    }
    mesh_.positions.push_back(p);
    const std::size_t more = header_.coordinates;
    if (recordsEndLines_) return endRecord("vertex", more, {0, 3, 4});
    for (std::size_t i = 0; i < more + (header_.colours ? 4 : 0); ++i) {
      need("vertex (x y z)");
      in_.number("vertex");
    }
  }
  void readFace(std::size_t f) {
    if (!in_.ahead()) in_.fail(fmt::format("the file ends after {} of {} faces", f, header_.faces));
    const auto corners = in_.integer("count of corners", 0, static_cast<std::int64_t>(in_.left()));
    corners_.clear();
    for (std::int64_t k = 0; k < corners; ++k) {
      if (!in_.ahead()) in_.fail("corner of a face is missing");
      const std::int64_t v = in_.integer("corner of a face");
      const bool there = v >= 0 && v < static_cast<std::int64_t>(header_.vertices);
      corners_.push_back(there ? static_cast<std::uint32_t>(v) : kBadIndex);
    }
    faces_.add(corners_);
    if (recordsEndLines_) endRecord("face", 0, {0, 1, 3, 4});
  }
  void need(std::string_view what) {
    if (recordsEndLines_ ? !in_.more() : !in_.ahead()) in_.fail(fmt::format("{} is missing", what));
  }
  void endRecord(std::string_view record, std::size_t fixed, std::initializer_list<std::size_t> colours) {
    std::size_t count = 0;
    for (; in_.more(); ++count) in_.number(record);
    if (count < fixed || std::ranges::find(colours, count - fixed) == colours.end())
      in_.fail(fmt::format("{} numbers follow the {} on its line; a colour has {}", count, record,
                           record == "face" ? "1, 3 or 4" : "3 or 4"));
  }

  Scanner in_;
  const Header& header_;
  const bool recordsEndLines_;
  Mesh mesh_;
  Faces faces_{mesh_};
  std::vector<std::uint32_t> corners_;
};

}  // namespace

Mesh readOff(const FileText& file) {
  const Header header = readHeader(file);
  Body lines(file, header, true);
  try {
    return lines.read();
  } catch (const Error& error) {
    // Without colours, line ends mean nothing. The message of the attempt that came farther is the one of use.
    Body words(file, header, false);
    try {
      return words.read();
    } catch (const Error&) {
      if (words.at() > lines.at()) throw;
    }
    throw error;
  }
}

}  // namespace tessera::datasets
