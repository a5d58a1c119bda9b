// A replay file holds what the pipeline gets after its transform, as text: hexadecimal bits of float32, so that NaNs,
// their payloads and the sign of zero survive, and that two files can be compared by eye.
//
//     tessera-replay 1
//     name NAME                  may have spaces, or be empty
//     size WIDTH HEIGHT
//     vertices COUNT             then a line each: x y z w as 8 hexadecimal digits
//     triangles COUNT            then a line each: three vertex indices, decimal
//     attribute NAME             where there is one: then a line a vertex: its value as 8 hexadecimal digits
//     end
#include <fmt/format.h>
#include <tessera/error.h>
#include <tessera/input.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <iterator>

#include "datasets/scanner.h"
#include "datasets/text.h"
#include "host/support/files.h"

namespace tessera {
namespace {

constexpr std::string_view kFirst = "tessera-replay";

/// The contract's transform (see host/include/tessera/rasterizer.h).
glm::vec4 transform(const Matrix& m, const glm::vec3& p) {
  const auto row = [&](std::size_t r) { return ((m[r] * p.x + m[r + 1] * p.y) + m[r + 2] * p.z) + m[r + 3]; };
  return {row(0), row(4), row(8), row(12)};
}

class Reader {
 public:
  explicit Reader(const datasets::FileText& file)
      : in_(file, datasets::Scanner::Syntax::kPlain), most_(static_cast<std::int64_t>(file.text.size())) {}

  Scene read() {
    expect(kFirst);
    if (const std::string_view version = in_.wordInLine("the version"); version != "1")
      in_.fail(fmt::format("version {}; 1 would be right", datasets::shown(version)));
    Scene scene;
    expect("name");
    scene.name = in_.rest();
    expect("size");
    scene.width = integer("width", 1, kMaxExtent);
    scene.height = integer("height", 1, kMaxExtent);
    expect("vertices");
    scene.clip.resize(count("count of vertices"));
    for (glm::vec4& p : scene.clip) {
      needLine("the last vertex");
      for (int axis = 0; axis < 4; ++axis) p[axis] = fromBits("clip position (4 words)");
    }
    expect("triangles");
    scene.triangles.resize(count("count of triangles"));
    for (Triangle& t : scene.triangles) {
      needLine("the last triangle");
      for (std::uint32_t& v : t) v = integer("vertex index", 0, 0xffffffff);
    }
    needLine("end");
    std::string_view word = in_.word();
    if (word == "attribute") {
      Stream& stream =
          scene.streams.emplace_back(Stream{std::string(in_.wordInLine("name of the attribute")), 1, {}, true});
      stream.values.resize(scene.clip.size());
      for (float& value : stream.values) {
        needLine("the last value");
        value = fromBits("value");
      }
      needLine("end");
      word = in_.word();
    }
    if (word != "end" || in_.ahead()) in_.fail("'end', and then the file's end, would be right");
    return scene;
  }

 private:
  /// Goes to the next line; what is left of this one is too much.
  void needLine(std::string_view what) {
    if (in_.at() != 0 && in_.more())
      in_.fail(fmt::format("{} where the line's end would be right", datasets::shown(in_.word())));
    in_.needAhead(what);
  }
  void expect(std::string_view word) {
    needLine(word);
    if (in_.word() != word) in_.fail(fmt::format("'{}' would be right", word));
  }
  std::uint32_t integer(std::string_view what, std::int64_t least, std::int64_t most) {
    if (!in_.more()) in_.fail(fmt::format("{} is missing", what));
    return static_cast<std::uint32_t>(in_.integer(what, least, most));
  }
  /// Of things with a line each, so it is not beyond the file's size.
  std::uint32_t count(std::string_view what) { return integer(what, 0, std::min<std::int64_t>(most_, 0xffffffff)); }
  float fromBits(std::string_view what) {
    const std::string_view word = in_.wordInLine(what);
    std::uint32_t bits = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), bits, 16);
    if (word.size() != 8 || error != std::errc{} || end != word.data() + word.size())
      in_.fail(fmt::format("{} is not the bits of a float32 in 8 hexadecimal digits", datasets::shown(word)));
    return std::bit_cast<float>(bits);
  }

  datasets::Scanner in_;
  const std::int64_t most_;
};

}  // namespace

void writeReplay(const std::filesystem::path& path, const Scene& scene) {
  std::string name = scene.name;
  std::ranges::replace_if(
      name, [](char c) { return c == '\n' || c == '\r'; }, ' ');
  fmt::memory_buffer text;
  auto out = std::back_inserter(text);
  fmt::format_to(out, "{} 1\nname {}\nsize {} {}\nvertices {}\n", kFirst, name, scene.width, scene.height,
                 scene.vertexCount());
  for (std::size_t v = 0; v < scene.vertexCount(); ++v) {
    const auto p = std::bit_cast<std::array<std::uint32_t, 4>>(
        scene.positions.empty() ? scene.clip[v] : transform(scene.clipFromObject, scene.positions[v]));
    fmt::format_to(out, "{:08x} {:08x} {:08x} {:08x}\n", p[0], p[1], p[2], p[3]);
  }
  fmt::format_to(out, "triangles {}\n", scene.triangles.size());
  for (const Triangle& t : scene.triangles) fmt::format_to(out, "{} {} {}\n", t[0], t[1], t[2]);
  if (const Stream* stream = scene.attribute(); stream != nullptr && stream->components == 1) {
    fmt::format_to(out, "attribute {}\n", stream->name);
    for (const float value : stream->values) fmt::format_to(out, "{:08x}\n", std::bit_cast<std::uint32_t>(value));
  }
  fmt::format_to(out, "end\n");
  support::writeWhole(path, {text.data(), text.size()});
}

Scene readReplay(const std::filesystem::path& path) {
  const std::string name = path.string(), bytes = datasets::readFile(path);
  const ReadProgress none;
  const datasets::FileText file{name, datasets::plainText(name, bytes), none};
  return Reader(file).read();
}

}  // namespace tessera
