#include "datasets/stl.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstring>
#include <unordered_map>

#include "datasets/text.h"
#include "host/error.h"

namespace tessera {
namespace {

static_assert(std::endian::native == std::endian::little, "binary STL is little-endian and is copied as it is");

using Bits = std::array<std::uint32_t, 3>;
struct HashBits {
  std::size_t operator()(const Bits& b) const {
    std::uint64_t hash = b[0];
    for (const std::uint32_t word : {b[1], b[2]}) hash = (hash ^ (hash >> 29)) * 0x9e3779b97f4a7c15u + word;
    return hash ^ (hash >> 32);
  }
};

struct Facets {
  Mesh mesh;
  std::unordered_map<Bits, std::uint32_t, HashBits> vertices;

  std::uint32_t vertex(const glm::vec3& p) {
    const auto [found, isNew] =
        vertices.try_emplace(std::bit_cast<Bits>(p), static_cast<std::uint32_t>(mesh.positions.size()));
    if (isNew) mesh.positions.emplace_back(p);
    return found->second;
  }
};

// 80 bytes of any text, the count, then 50 bytes a facet: normal, three corners, a 16-bit attribute.
constexpr std::size_t kHeader = 84, kFacet = 50;

Mesh readBinary(std::string_view text, std::uint32_t count) {
  Facets facets;
  facets.mesh.float32 = true;
  facets.mesh.triangles.reserve(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    std::array<glm::vec3, 3> corners;
    std::memcpy(corners.data(), text.data() + kHeader + i * kFacet + sizeof(glm::vec3), sizeof corners);
    facets.mesh.triangles.push_back({facets.vertex(corners[0]), facets.vertex(corners[1]), facets.vertex(corners[2])});
  }
  return std::move(facets.mesh);
}

Mesh readText(const std::string& name, std::string_view text) {
  Facets facets;
  Lines lines(name, text, Lines::Comments::kNone);
  std::vector<std::uint32_t> corners;
  std::string word;
  while (lines.next()) {
    word = lowerCase(lines.words()[0]);
    if (word == "vertex") {
      corners.push_back(
          facets.vertex({lines.real(1, "vertex x"), lines.real(2, "vertex y"), lines.real(3, "vertex z")}));
    } else if (word == "endloop") {
      if (corners.size() != 3) lines.fail(fmt::format("a facet has {} vertices; 3 would be right", corners.size()));
      facets.mesh.triangles.push_back({corners[0], corners[1], corners[2]});
      corners.clear();
    } else if (word != "solid" && word != "facet" && word != "outer" && word != "endfacet" && word != "endsolid") {
      lines.fail(
          fmt::format("'{}' where vertex, facet, outer loop, endloop, endfacet or endsolid would be right", word));
    }
  }
  if (!corners.empty() || word != "endsolid") lines.fail("the file ends before endsolid");
  return std::move(facets.mesh);
}

}  // namespace

Mesh readStl(const std::string& name, std::string_view text) {
  std::uint32_t count = 0;
  if (text.size() >= kHeader) {
    std::memcpy(&count, text.data() + kHeader - sizeof count, sizeof count);
    if (text.size() == kHeader + count * kFacet) return readBinary(text, count);
  }
  if (lowerCase(text.substr(0, 5)) == "solid" && text.find('\0') == text.npos) return readText(name, text);
  failUsage(fmt::format(
      "{}: neither STL text (which begins with 'solid') nor binary STL: {} facets would take {} bytes, the file has {}",
      name, count, kHeader + count * kFacet, text.size()));
}

}  // namespace tessera
