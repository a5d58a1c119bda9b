// Wavefront OBJ: the lines v, vn and f. The other statements of the format say nothing about triangles, or are curves
// and surfaces, which are named in a note.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tessera/error.h>

#include <algorithm>
#include <bit>
#include <map>

#include "datasets/bits-table.h"
#include "datasets/faces.h"
#include "datasets/mesh-formats.h"
#include "datasets/text.h"

namespace tessera::datasets {
namespace {

/// What has no triangles (vertex data, points, lines, grouping, display and materials), by the format's specification
/// (Object Files, version 3.0), with what it says is superseded.
constexpr std::array<std::string_view, 32> kNoTriangles{
    "vt",     "vp",       "p",        "l",   "g",      "s",      "mg",         "o",
    "bevel",  "c_interp", "d_interp", "lod", "usemtl", "mtllib", "shadow_obj", "trace_obj",
    "usemap", "maplib",   "cstype",   "deg", "bmat",   "step",   "parm",       "trim",
    "hole",   "scrv",     "sp",       "end", "con",    "ctech",  "stech",      "res"};
/// What has triangles or curves in a viewer that knows it, and none here.
constexpr std::array<std::string_view, 9> kLeftOut{"curv", "curv2", "surf", "bsp", "bzp", "cdc", "cdp", "call", "csh"};

constexpr std::uint32_t kNoNormal = kBadIndex, kBadNormal = kBadIndex - 1;

class Reader {
 public:
  explicit Reader(const FileText& file) : in_(file, Scanner::Syntax::kHashAndBackslash) {}

  Mesh read() {
    while (in_.line()) readStatement();
    if (mesh_.positions.empty() && mesh_.triangles.empty() && leftOut_.empty())
      in_.fail("no vertex (v x y z) and no face (f a b c) in the whole file");
    for (Triangle& t : mesh_.triangles)
      for (std::uint32_t& v : t)
        if (v >= mesh_.positions.size()) v = kBadIndex;  // only now: a face may come before its vertices
    if (!cornerNormals_.empty()) giveNormals();
    faces_.finish();
    if (!leftOut_.empty()) {
      std::vector<std::string> counts;
      for (const auto& [word, count] : leftOut_) counts.push_back(fmt::format("{} {}", count, word));
      mesh_.notes.push_back(fmt::format("statements that are not read: {}", fmt::join(counts, ", ")));
    }
    return std::move(mesh_);
  }

 private:
  template <class Words>
  static bool contains(const Words& words, std::string_view word) {
    return std::ranges::find(words, word) != words.end();
  }
  static bool isStatement(std::string_view word) {
    return word == "v" || word == "f" || word == "vn" || contains(kNoTriangles, word) || contains(kLeftOut, word);
  }
  void readStatement() {
    const std::string_view word = in_.word();
    if (word == "v") {
      mesh_.positions.push_back(readVertex());
    } else if (word == "f") {
      readFace();
    } else if (word == "vn") {
      normals_.emplace_back(readThree("normal (vn x y z)"));
    } else {
      const bool leftOut = contains(kLeftOut, word);
      if (!leftOut && !contains(kNoTriangles, word))
        in_.fail(fmt::format("{} is no statement of OBJ; v, vn, vt, f, g or another one would be right", shown(word)));
      if (leftOut) ++leftOut_[word];
      in_.leaveLine(isStatement);
    }
  }

  glm::dvec3 readThree(std::string_view what) {
    glm::dvec3 p;
    for (int axis = 0; axis < 3; ++axis) {
      if (!in_.more()) in_.fail(fmt::format("{} is missing", what));
      p[axis] = in_.real(what);
    }
    return p;
  }
  /// A weight, which only curves use, or a colour may follow, or both.
  glm::dvec3 readVertex() {
    constexpr std::string_view kWhat = "vertex (v x y z)";
    const glm::dvec3 p = readThree(kWhat);
    std::size_t more = 0;
    for (; in_.more(); ++more) in_.number(kWhat);
    if (more == 2 || more > 4)
      in_.fail(fmt::format("a vertex has {} numbers; x y z, and a weight or a colour, would be right", 3 + more));
    return p;
  }

  void readFace() {
    corners_.clear();
    normalsOfCorners_.clear();
    bool hasNormals = false;
    while (in_.more()) {
      readCorner();
      hasNormals |= normalsOfCorners_.back() != kNoNormal;
    }
    if (corners_.size() < 3) in_.fail("a face has fewer than 3 corners");
    const std::size_t first = mesh_.triangles.size();
    faces_.add(corners_);
    if (!hasNormals && cornerNormals_.empty()) return;
    cornerNormals_.resize(first, {kNoNormal, kNoNormal, kNoNormal});
    for (std::size_t i = 2; i < corners_.size(); ++i)
      cornerNormals_.push_back({normalsOfCorners_[0], normalsOfCorners_[i - 1], normalsOfCorners_[i]});
  }

  /// "position/texture/normal", the last two left out or empty. Counted from 1, from the last one so far where
  /// negative.
  void readCorner() {
    const std::string_view word = in_.word();
    const auto index = [](std::string_view text, std::size_t count, std::uint32_t& result) {
      std::int64_t value = 0;
      const bool negative = text.starts_with('-');
      const char* p = text.data() + negative;
      const char* const end = text.data() + text.size();
      if (end - p < 1 || end - p > 18) {
        const auto whole = toInteger(text);
        if (!whole) return false;
        value = *whole;
      } else {
        for (; p != end; ++p) {
          if (static_cast<unsigned char>(*p - '0') > 9) return false;
          value = 10 * value + (*p - '0');
        }
        if (negative) value = -value;
      }
      if (value < 0) value += static_cast<std::int64_t>(count) + 1;
      result = value < 1 || value >= kBadIndex ? kBadIndex : static_cast<std::uint32_t>(value - 1);
      return true;
    };
    const std::size_t slash = std::min(word.find('/'), word.size());
    std::uint32_t position = 0, texture = 0, normal = kNoNormal;
    if (!index(word.substr(0, slash), mesh_.positions.size(), position))
      in_.fail(fmt::format("corner {} of a face does not begin with a whole number", shown(word)));
    if (slash < word.size()) {
      const std::size_t second = std::min(word.find('/', slash + 1), word.size());
      const std::string_view texturePart = word.substr(slash + 1, second - slash - 1);
      const std::string_view normalPart = second < word.size() ? word.substr(second + 1) : std::string_view{};
      if (!texturePart.empty() && !index(texturePart, 0, texture))
        in_.fail(fmt::format("corner {} of a face: the texture coordinate is not a whole number", shown(word)));
      if (!normalPart.empty() && !index(normalPart, normals_.size(), normal))
        in_.fail(fmt::format("corner {} of a face: the normal is not a whole number", shown(word)));
      if (!normalPart.empty() && normal == kBadIndex) normal = kBadNormal;
    }
    corners_.push_back(position);
    normalsOfCorners_.push_back(normal);
  }

  /// OBJ numbers normals apart from positions: a vertex gets the first normal that a face gives it, and for each other
  /// one a twin behind the file's vertices.
  void giveNormals() {
    const std::size_t count = mesh_.positions.size();
    mesh_.normals.resize(count, glm::vec3(0));
    BitsTable<std::uint32_t, 4> twins;
    std::size_t lost = 0;
    for (std::size_t t = 0; t < cornerNormals_.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        std::uint32_t& v = mesh_.triangles[t][k];
        if (cornerNormals_[t][k] >= normals_.size()) {
          lost += cornerNormals_[t][k] != kNoNormal;
          continue;
        }
        if (v >= count) continue;
        const glm::vec3 normal = normals_[cornerNormals_[t][k]];
        glm::vec3& own = mesh_.normals[v];
        if (own == glm::vec3(0)) own = normal;
        if (own == normal) continue;
        const auto bits = std::bit_cast<std::array<std::uint32_t, 3>>(normal);
        const auto [twin, fresh] = twins.add({v, bits[0], bits[1], bits[2]});
        if (fresh) {
          mesh_.positions.push_back(mesh_.positions[v]);
          mesh_.normals.push_back(normal);
        }
        v = static_cast<std::uint32_t>(count) + twin;
      }
    }
    if (lost != 0)
      mesh_.notes.push_back(fmt::format("{} of triangles without the normal that the file names: it is computed",
                                        lost == 1 ? "1 corner" : fmt::format("{} corners", lost)));
  }

  Scanner in_;
  Mesh mesh_;
  Faces faces_{mesh_};
  std::vector<glm::vec3> normals_;
  std::vector<Triangle>
      cornerNormals_;  ///< normals of the triangles' corners; shorter than these, or empty, where none follow
  std::vector<std::uint32_t> corners_, normalsOfCorners_;  ///< of the face that is being read
  std::map<std::string_view, std::size_t> leftOut_;
};

}  // namespace

Mesh readObj(const FileText& file) { return Reader(file).read(); }

}  // namespace tessera::datasets
