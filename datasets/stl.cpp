// STL, text or binary: facets in order; corners with the same bits share a vertex. The normals of the file are not
// taken: they belong to facets.
#include <fmt/format.h>
#include <tessera/error.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "datasets/bits-table.h"
#include "datasets/mesh-formats.h"
#include "datasets/text.h"
#include "host/support/text.h"

namespace tessera::datasets {
namespace {

static_assert(std::endian::native == std::endian::little, "binary STL is little-endian and is copied as it is");

// 80 bytes of any text, the count, then 50 bytes a facet: normal, three corners, a 16-bit attribute.
constexpr std::size_t kHeader = 84, kFacet = 50;

std::uint32_t countOf(std::string_view text) {
  std::uint32_t count = 0;
  if (text.size() >= kHeader) std::memcpy(&count, text.data() + kHeader - sizeof count, sizeof count);
  return count;
}
std::uint64_t binarySize(std::string_view text) { return kHeader + std::uint64_t{countOf(text)} * kFacet; }

/// Makes a mesh of facets. A facet waits until some more have come, so that the memory which holds its vertices'
/// numbers is there when the facet's turn comes.
template <class Word>
class Facets {
 public:
  using Corners = std::array<std::array<Word, 3>, 3>;  ///< the bits of the coordinates

  explicit Facets(std::size_t count = 0) : vertices_(count / 2) {  // of a closed surface
    reserveHuge(mesh_.triangles, count);
    reserveHuge(mesh_.positions, count / 2);
  }
  void add(const Corners& corners) {
    if (begun_ >= kAhead) finishOldest();
    Waiting& facet = waiting_[begun_++ % kAhead];
    facet.corners = corners;
    for (std::size_t k = 0; k < 3; ++k) {
      facet.hashes[k] = Vertices::hash(corners[k]);
      vertices_.prefetch(facet.hashes[k]);
    }
  }
  Mesh take() && {
    while (mesh_.triangles.size() < begun_) finishOldest();
    return std::move(mesh_);
  }

 private:
  using Vertices = BitsTable<Word, 3>;
  using Position = std::conditional_t<sizeof(Word) == sizeof(float), glm::vec3, glm::dvec3>;
  struct Waiting {
    Corners corners;
    std::array<std::uint64_t, 3> hashes;
  };
  static constexpr std::size_t kAhead = 16;

  void finishOldest() {
    const Waiting& facet = waiting_[mesh_.triangles.size() % kAhead];
    Triangle triangle;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [number, fresh] = vertices_.add(facet.corners[k], facet.hashes[k]);
      if (fresh) mesh_.positions.emplace_back(std::bit_cast<Position>(facet.corners[k]));
      triangle[k] = number;
    }
    mesh_.triangles.push_back(triangle);
  }

  Mesh mesh_;
  Vertices vertices_;
  std::array<Waiting, kAhead> waiting_;
  std::size_t begun_ = 0;  ///< facets; those that are finished are the mesh's triangles
};

/// The facets of a binary file; `next` gives the bytes that follow, of the size it is asked for.
template <class Next>
Mesh readBinary(std::size_t count, const ReadProgress& progress, const Next& next) {
  constexpr std::size_t kAtOnce = 4096;  // 200 KB, which stay in a core's cache
  Facets<std::uint32_t> facets(count);
  for (std::size_t i = 0; i < count; i += kAtOnce) {
    const std::string_view piece = next(kFacet * std::min(kAtOnce, count - i));
    for (std::size_t at = 0; at < piece.size(); at += kFacet) {
      typename decltype(facets)::Corners corners;
      std::memcpy(corners.data(), piece.data() + at + sizeof(glm::vec3), sizeof corners);
      facets.add(corners);
    }
    if (progress) progress(kHeader + i * kFacet, kHeader + count * kFacet);
  }
  Mesh mesh = std::move(facets).take();
  mesh.float32 = true;
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
      while (readFacet()) continue;
      while (in_.more() && !startsSolid()) in_.word();
    } while (in_.ahead());
    return std::move(facets_).take();
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
  /// The next word, which has to be there; `what` says in a message what is missing.
  std::string_view next(std::string_view what) {
    in_.needAhead(what);
    return in_.word();
  }
  void expect(std::string_view word) { require(next(word), word); }
  void require(std::string_view found, std::string_view word) {
    if (!same(found, word)) in_.fail(fmt::format("{} where {} would be right", shown(found), word));
  }
  /// False at the end of the solid.
  bool readFacet() {
    const std::string_view begin = next("endsolid");
    if (!same(begin, "facet")) {
      require(begin, "endsolid");
      return false;
    }
    expect("normal");
    for (int k = 0; k < 3; ++k) {
      in_.needAhead("the facet's normal");
      in_.number("normal of a facet");
    }
    for (const char* const word : {"outer", "loop"}) expect(word);
    decltype(facets_)::Corners corners;
    for (auto& corner : corners) {
      const std::string_view word = next("vertex");
      if (same(word, "endloop")) in_.fail("a facet has fewer than 3 vertices; 3 would be right");
      require(word, "vertex");
      glm::dvec3 p;
      for (int axis = 0; axis < 3; ++axis) {
        constexpr std::array<std::string_view, 3> kNames{"vertex x", "vertex y", "vertex z"};
        const std::string_view name = kNames[static_cast<std::size_t>(axis)];
        in_.needAhead(name);
        p[axis] = in_.real(name);
      }
      corner = std::bit_cast<std::array<std::uint64_t, 3>>(p);
    }
    const std::string_view end = next("endloop");
    if (same(end, "vertex")) in_.fail("a facet has more than 3 vertices; 3 would be right");
    require(end, "endloop");
    expect("endfacet");
    facets_.add(corners);
    return true;
  }

  Scanner in_;
  Facets<std::uint64_t> facets_;
};

}  // namespace

Mesh readStl(InputFile& file, const ReadProgress& progress) {
  // The size decides: many binary files, too, begin with "solid".
  std::string begin(kHeader, '\0');
  begin.resize(file.read(begin.data(), begin.size()));
  if (file.size() >= kHeader && file.size() == binarySize(begin)) {
    std::string piece;
    return readBinary(countOf(begin), progress, [&](std::size_t bytes) -> std::string_view {
      piece.resize(bytes);
      if (file.read(piece.data(), bytes) != bytes)
        failUsage(fmt::format("{}: became shorter while it was read", file.name()));
      return piece;
    });
  }
  const FileBytes bytes(file, begin);
  const std::string_view all = bytes.view();
  if (all.size() == binarySize(all)) {  // a pipe
    std::string_view left = all.substr(kHeader);
    return readBinary(countOf(all), progress, [&](std::size_t size) {
      const std::string_view piece = left.substr(0, size);
      left.remove_prefix(size);
      return piece;
    });
  }
  const std::string_view text = plainText(file.name(), all);
  const std::size_t first = std::min(text.find_first_not_of(" \t\r\n\v\f"), text.size());
  if (support::lowerCase(text.substr(first, 5)) == "solid" && text.find('\0') == text.npos)
    return TextReader({file.name(), text, progress}).read();
  if (all.size() < kHeader)
    failUsage(
        fmt::format("{}: neither STL text (which begins with 'solid') nor binary STL (84 bytes or more)", file.name()));
  failUsage(fmt::format(
      "{}: neither STL text (which begins with 'solid') nor binary STL: {} facets would take {} bytes, the file has {}",
      file.name(), countOf(all), binarySize(all), all.size()));
}

}  // namespace tessera::datasets
