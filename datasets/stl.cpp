// STL, text or binary: facets in order; corners with the same bits share a vertex. The normals of the file are not
// taken: they belong to facets.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "datasets/bits-table.h"
#include "datasets/mesh-formats.h"
#include "datasets/text.h"
#include "host/error.h"

namespace tessera {
namespace {

static_assert(std::endian::native == std::endian::little, "binary STL is little-endian and is copied as it is");

// 80 bytes of any text, the count, then 50 bytes a facet: normal, three corners, a 16-bit attribute.
constexpr std::size_t kHeader = 84, kFacet = 50;

std::uint32_t countOf(std::string_view text) {
  std::uint32_t count = 0;
  if (text.size() >= kHeader) std::memcpy(&count, text.data() + kHeader - sizeof count, sizeof count);
  return count;
}

Mesh readBinary(const FileText& file) {
  using Vertices = BitsTable<std::uint32_t, 3>;
  constexpr std::size_t kAhead = 16;  // facets whose slots are fetched while others are worked on
  const std::size_t count = countOf(file.text);
  Mesh mesh;
  mesh.float32 = true;
  resizeHuge(mesh.triangles, count);
  reserveHuge(mesh.positions, count / 2);  // of a closed surface
  Vertices vertices(count / 2);
  std::array<std::array<Vertices::Key, 3>, kAhead> corners;
  std::array<std::array<std::uint64_t, 3>, kAhead> hashes;
  for (std::size_t i = 0; i < count + kAhead; ++i) {
    auto& corner = corners[i % kAhead];
    auto& hash = hashes[i % kAhead];
    for (std::size_t k = 0; i >= kAhead && k < 3; ++k) {
      const auto [number, fresh] = vertices.add(corner[k], hash[k]);
      if (fresh) mesh.positions.emplace_back(std::bit_cast<glm::vec3>(corner[k]));
      mesh.triangles[i - kAhead][k] = number;
    }
    if (i >= count) continue;
    const std::size_t at = kHeader + i * kFacet;
    std::memcpy(corner.data(), file.text.data() + at + sizeof(glm::vec3), sizeof corner);
    for (std::size_t k = 0; k < 3; ++k) {
      hash[k] = Vertices::hash(corner[k]);
      vertices.prefetch(hash[k]);
    }
    constexpr std::size_t kReportEvery = 1 << 16;
    if (file.progress && i % kReportEvery == 0) file.progress(at, file.text.size());
  }
  return mesh;
}

/// Free text: solid NAME, facets, endsolid NAME, and perhaps another solid. A name goes to the line's end, or where all
/// stands on one line to the first facet.
class TextReader {
 public:
  explicit TextReader(const FileText& file) : in_(file, Scanner::Syntax::kPlain) {}

  Mesh read() {
    in_.needAhead("solid");
    do {
      expect("solid");
      while (in_.more() && !startsFacets()) in_.word();
      while (isNext("facet")) readFacet();
      expect("endsolid");
      while (in_.more() && !startsSolid()) in_.word();
    } while (in_.ahead());
    return std::move(mesh_);
  }

 private:
  static bool same(std::string_view found, std::string_view word) {
    return std::ranges::equal(found, word, [](char a, char b) { return (a | ('a' - 'A')) == b; });
  }
  /// What `look` says of the words from here, without a step.
  template <class Look>
  bool peek(Look look) {
    const std::size_t before = in_.at();
    const bool found = look();
    in_.moveTo(before);
    return found;
  }
  bool takes(std::string_view word) { return in_.ahead() && same(in_.word(), word); }
  bool isNext(std::string_view word) {
    return in_.ahead() && peek([&] { return takes(word); });
  }
  bool startsFacets() {
    return isNext("endsolid") || peek([&] { return takes("facet") && takes("normal"); });
  }
  bool startsSolid() {
    return peek([&] {
      if (!takes("solid")) return false;
      while (in_.more() && !startsFacets()) in_.word();
      return in_.more();
    });
  }
  void expect(std::string_view word) {
    in_.needAhead(word);
    const std::string_view found = in_.word();
    if (!same(found, word)) in_.fail(fmt::format("{} where {} would be right", shown(found), word));
  }
  void readFacet() {
    for (const char* const word : {"facet", "normal"}) expect(word);
    for (int k = 0; k < 3; ++k) {
      in_.needAhead("the facet's normal");
      in_.number("normal of a facet");
    }
    for (const char* const word : {"outer", "loop"}) expect(word);
    std::array<std::uint32_t, 3> corners;
    for (std::uint32_t& corner : corners) {
      if (isNext("endloop")) in_.fail("a facet has fewer than 3 vertices; 3 would be right");
      expect("vertex");
      glm::dvec3 p;
      for (int axis = 0; axis < 3; ++axis) {
        constexpr std::array<std::string_view, 3> kNames{"vertex x", "vertex y", "vertex z"};
        const std::string_view name = kNames[static_cast<std::size_t>(axis)];
        in_.needAhead(name);
        p[axis] = in_.real(name);
      }
      const auto [number, fresh] = vertices_.add(std::bit_cast<decltype(vertices_)::Key>(p));
      if (fresh) mesh_.positions.push_back(p);
      corner = number;
    }
    if (isNext("vertex")) in_.fail("a facet has more than 3 vertices; 3 would be right");
    for (const char* const word : {"endloop", "endfacet"}) expect(word);
    mesh_.triangles.push_back(corners);
  }

  Scanner in_;
  Mesh mesh_;
  BitsTable<std::uint64_t, 3> vertices_;
};

}  // namespace

Mesh readStl(const FileText& file) {
  // The size decides: many binary files, too, begin with "solid".
  const std::uint64_t binarySize = kHeader + std::uint64_t{countOf(file.text)} * kFacet;
  if (file.text.size() == binarySize) return readBinary(file);
  const std::string_view text = plainText(file.name, file.text);
  const std::size_t first = std::min(text.find_first_not_of(" \t\r\n\v\f"), text.size());
  if (lowerCase(text.substr(first, 5)) == "solid" && text.find('\0') == text.npos)
    return TextReader({file.name, text, file.progress}).read();
  if (file.text.size() < kHeader)
    failUsage(
        fmt::format("{}: neither STL text (which begins with 'solid') nor binary STL (84 bytes or more)", file.name));
  failUsage(fmt::format(
      "{}: neither STL text (which begins with 'solid') nor binary STL: {} facets would take {} bytes, the file has {}",
      file.name, countOf(file.text), binarySize, file.text.size()));
}

}  // namespace tessera
