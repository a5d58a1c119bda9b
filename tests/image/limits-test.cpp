// Small files that ask for a lot, and headers that do not hold together: refused from their header, in one line.
#include <tessera/error.h>
#include <tessera/image.h>

#include <catch2/catch.hpp>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

#include "host/support/files.h"

using namespace tessera;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

template <typename... Numbers>
std::string bytes(Numbers... numbers) {
  std::string text;
  (text.append(reinterpret_cast<const char*>(&numbers), sizeof numbers), ...);
  return text;
}

std::string attribute(const std::string& name, const std::string& type, const std::string& value) {
  return name + '\0' + type + '\0' + bytes(static_cast<std::int32_t>(value.size())) + value;
}

// By hand, "OpenEXR File Layout": what no library would write.
struct Header {
  std::uint32_t flags = 0;
  int channels = 2;
  std::int32_t sampling = 1;
  std::uint8_t compression = 3;
  std::int32_t x = 0, y = 0, width = 64, height = 64, displayWidth = 64, displayHeight = 64;
  std::string more = {};

  std::string text() const {
    std::string list;
    for (int c = 0; c < channels; ++c) {
      list += "c" + std::to_string(c) + '\0';
      list += bytes(std::uint32_t{2}, std::uint32_t{0}, sampling, sampling);
    }
    using namespace std::string_literals;
    return bytes(std::uint32_t{20000630}, 2u | flags) + more + attribute("channels", "chlist", list + "\0"s) +
           attribute("compression", "compression", bytes(compression)) +
           attribute("dataWindow", "box2i", bytes(x, y, x + width - 1, y + height - 1)) +
           attribute("displayWindow", "box2i", bytes(0, 0, displayWidth - 1, displayHeight - 1)) +
           attribute("lineOrder", "lineOrder", "\0"s) + attribute("pixelAspectRatio", "float", bytes(1.0f)) +
           attribute("screenWindowCenter", "v2f", bytes(0.0f, 0.0f)) +
           attribute("screenWindowWidth", "float", bytes(1.0f)) + "\0"s + std::string(16384, '\0');
  }
};

std::string refusalOf(const std::string& text, std::uint64_t limit = 0) {
  const support::TemporaryFolder folder(support::temporaryRoot(), "tessera-image-limits-test");
  const fs::path path = folder.path() / "a.exr";
  std::ofstream(path, std::ios::binary) << text;
  try {
    readImage(path, limit);
  } catch (const Error& error) {
    CHECK(error.code() == ExitCode::kUsage);
    const std::string line = error.what();
    CHECK_THAT(line, Contains("a.exr") && !Contains("\n"));
    return line;
  }
  return "(nothing was thrown)";
}
std::string refusal(const Header& header, std::uint64_t limit = 0) { return refusalOf(header.text(), limit); }

}  // namespace

TEST_CASE("a small exr that unpacks to a lot is refused by a limit that an option raises") {
  const auto limited = Contains("the limit is 512 MiB; --max-unpacked raises it");
  CHECK_THAT(refusal({.channels = 402, .width = 32768, .height = 32768}), Contains("402 channels") && limited);
  CHECK_THAT(refusal({.compression = 4, .width = 32768, .height = 32768}), limited);
  CHECK_THAT(refusal({.width = 16384, .height = 8192}), limited);
  CHECK_THAT(refusal({.width = 8192, .height = 8192}), !Contains("--max-unpacked"));               // 512 MiB
  CHECK_THAT(refusal({.channels = 100, .compression = 9, .width = 32768, .height = 1}), limited);  // 256 rows a chunk
  CHECK_THAT(refusal({.channels = 500}, 1 << 20), Contains("--max-unpacked") && Contains("the limit is 1 MiB"));
  CHECK_THAT(refusal({.channels = 500}, 1 << 30), Contains("holds channels") || Contains("not a whole OpenEXR file"));
}

TEST_CASE("a small exr of many channels that unpacks to little is read") {
  const support::TemporaryFolder folder(support::temporaryRoot(), "tessera-image-limits-test");
  Framebuffer frame{.width = 8, .height = 8, .depth = {}, .ids = {}, .hits = {}, .colour = {}};
  frame.hits.assign(64, 3);
  const fs::path path = folder.path() / "a.exr";
  writeImage(path, frame);
  CHECK(readImage(path).hits == frame.hits);
  CHECK_THROWS_WITH(readImage(path, 100), Contains("--max-unpacked"));
}

TEST_CASE("an exr with a window that no image has is refused") {
  CHECK_THAT(refusal({.width = 32769}), Contains("32769 x 64") && Contains("1 x 1 to 32768 x 32768"));
  CHECK_THAT(refusal({.height = 2147483647}), Contains("64 x 2147483647"));
  CHECK_THAT(refusal({.width = 0}), Contains("0 x 64"));
  CHECK_THAT(refusal({.height = -5}), Contains("64 x -5"));
  CHECK_THAT(refusal({.x = 2147483000}), Contains("begin at (2147483000, 0)"));
  CHECK_THAT(refusal({.y = -2147483647}), Contains("-2147483647"));
  CHECK_THAT(refusal({.displayWidth = 2147483647, .displayHeight = 2147483647}), Contains("in its display window"));
}

TEST_CASE("an exr that is not one part of plain scanlines is refused") {
  CHECK_THAT(refusal({.flags = 0x200}), Contains("tiled"));
  CHECK_THAT(refusal({.flags = 0x800}), Contains("deep"));
  CHECK_THAT(refusal({.flags = 0x1000}), Contains("several parts"));
  CHECK_THAT(refusal({.sampling = 2}), Contains("a value a pixel"));
  CHECK_THAT(refusal({.compression = 77}), Contains("zip would be right"));
  // A type that a library does not know makes it believe the number of chunks.
  const std::string chunks = attribute("chunkCount", "int", bytes(std::int32_t{2147483647}));
  CHECK_THAT(refusal({.more = attribute("type", "string", "whatever") + chunks}), Contains("scanlineimage"));
}

TEST_CASE("an exr whose header claims more bytes than the file has is refused") {
  using namespace std::string_literals;
  const auto claiming = [](std::int32_t size) { return "comments\0string\0"s + bytes(size); };
  CHECK_THAT(refusal({.more = claiming(2147483647)}), Contains("its attribute comments has 2147483647 bytes"));
  CHECK_THAT(refusal({.more = claiming(-1)}), Contains("its attribute comments has -1 bytes"));
  CHECK_THAT(refusal({.more = std::string(1000, 'x')}), Contains("has no end"));
  const std::string whole = Header{}.text();
  for (const std::size_t length : {0, 3, 7, 9, 40, 80, 200}) {
    CAPTURE(length);
    CHECK_THAT(refusalOf(whole.substr(0, length)), Contains("not a whole OpenEXR file"));
  }
  CHECK_THAT(refusalOf(bytes(std::uint32_t{20000630}, 2u) + '\0'), Contains("no data window"));
}
