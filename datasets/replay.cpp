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

#include <algorithm>
#include <bit>
#include <charconv>
#include <iterator>

#include "datasets/input.h"
#include "datasets/text.h"
#include "host/error.h"
#include "host/files.h"

namespace tessera {
namespace {

constexpr std::string_view kFirst = "tessera-replay";

/// The contract's transform (see host/rasterizer.h).
glm::vec4 transform(const Matrix& m, const glm::vec3& p) {
  const auto row = [&](std::size_t r) { return ((m[r] * p.x + m[r + 1] * p.y) + m[r + 2] * p.z) + m[r + 3]; };
  return {row(0), row(4), row(8), row(12)};
}

float fromBits(const Lines& lines, std::size_t i, std::string_view what = "clip position (4 words)") {
  const std::string_view word = lines.word(i, what);
  std::uint32_t bits = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), bits, 16);
  if (word.size() != 8 || error != std::errc{} || end != word.data() + word.size())
    lines.fail(fmt::format("'{}' is not the bits of a float32 in 8 hexadecimal digits", word));
  return std::bit_cast<float>(bits);
}

/// Moves on to the line that begins with `word` and has `count` words after it.
void expect(Lines& lines, std::string_view word, std::size_t count) {
  lines.need(word);
  if (lines.words()[0] != word || lines.words().size() != count + 1)
    lines.fail(fmt::format("'{}' with {} values would be right", word, count));
}

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
  if (!scene.attribute.empty()) {
    fmt::format_to(out, "attribute {}\n", scene.attributeName);
    for (const float value : scene.attribute) fmt::format_to(out, "{:08x}\n", std::bit_cast<std::uint32_t>(value));
  }
  fmt::format_to(out, "end\n");
  if (!writeBeside(path, {text.data(), text.size()})) fail(fmt::format("{}: cannot be written", path.string()));
}

Scene readReplay(const std::filesystem::path& path) {
  const std::string text = readFile(path);
  const auto most = static_cast<std::int64_t>(text.size());  // a line each, so no count is beyond it
  Lines lines(path.string(), text, Lines::Comments::kNone);
  expect(lines, kFirst, 1);
  if (lines.words()[1] != "1") lines.fail(fmt::format("version '{}'; 1 would be right", lines.words()[1]));
  Scene scene;
  lines.need("name");
  const auto& words = lines.words();
  if (words[0] != "name") lines.fail("'name' would be right");
  if (words.size() > 1) scene.name.assign(words[1].begin(), words.back().end());
  expect(lines, "size", 2);
  scene.width = static_cast<std::uint32_t>(lines.integer(1, "width", 1, kMaxExtent));
  scene.height = static_cast<std::uint32_t>(lines.integer(2, "height", 1, kMaxExtent));
  expect(lines, "vertices", 1);
  scene.clip.resize(static_cast<std::size_t>(lines.integer(1, "count of vertices", 0, most)));
  for (glm::vec4& p : scene.clip) {
    lines.need("the last vertex");
    p = {fromBits(lines, 0), fromBits(lines, 1), fromBits(lines, 2), fromBits(lines, 3)};
  }
  expect(lines, "triangles", 1);
  scene.triangles.resize(static_cast<std::size_t>(lines.integer(1, "count of triangles", 0, most)));
  for (Triangle& t : scene.triangles) {
    lines.need("the last triangle");
    for (std::size_t k = 0; k < 3; ++k)
      t[k] = static_cast<std::uint32_t>(lines.integer(k, "vertex index", 0, 0xffffffff));
  }
  lines.need("end");
  if (lines.words()[0] == "attribute") {
    scene.attributeName = lines.word(1, "name of the attribute");
    scene.attribute.resize(scene.clip.size());
    for (float& value : scene.attribute) {
      lines.need("the last value");
      value = fromBits(lines, 0, "value");
    }
    lines.need("end");
  }
  if (lines.words() != std::vector<std::string_view>{"end"}) lines.fail("'end' with 0 values would be right");
  return scene;
}

}  // namespace tessera
