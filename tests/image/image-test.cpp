// Framebuffers to files and back, and every way in which that can fail.
#include <OpenImageIO/imageio.h>
#include <tessera/error.h>
#include <tessera/image.h>

#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include "host/support/files.h"
#include "tests/support/streams.h"

using namespace tessera;
using namespace tessera::test;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

enum Parts { kVisibility = 1, kHits = 2, kColour = 4, kAttribute = 8 };

Framebuffer randomFrame(std::uint32_t width, std::uint32_t height, int parts) {
  std::mt19937 random(width * 7919 + height);
  Framebuffer frame{.width = width, .height = height, .depth = {}, .ids = {}, .hits = {}, .colour = {}};
  const auto unit = [&] { return static_cast<float>(random() * 0x1p-32); };
  for (std::size_t k = 0; k < frame.pixels(); ++k) {
    if (parts & kVisibility) {
      // Bit patterns that a detour through float or half would lose: large odd ids, denormal depths.
      const std::uint32_t ids[] = {kNoTriangle, static_cast<std::uint32_t>(random()), 16777217u, 0u};
      const float depths[] = {1.0f, unit(), std::bit_cast<float>(static_cast<std::uint32_t>(random() % 1000)), 0.0f};
      frame.ids.push_back(ids[random() % 4]);
      frame.depth.push_back(depths[random() % 4]);
    }
    if (parts & kHits) frame.hits.push_back(static_cast<std::uint32_t>(random()));
    if (parts & kColour) frame.colour.emplace_back(unit(), unit(), unit());
    // Any bits, those of the NaN of empty pixels and of other NaNs among them.
    if (parts & kAttribute)
      valuesOf(frame).push_back(std::bit_cast<float>(k % 4 ? static_cast<std::uint32_t>(random()) : 0x7fc00000u));
  }
  return frame;
}

template <typename T>
bool sameBits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

bool sameBits(const Framebuffer& a, const Framebuffer& b) {
  return a.width == b.width && a.height == b.height && sameBits(a.depth, b.depth) && sameBits(a.ids, b.ids) &&
         sameBits(a.hits, b.hits) && sameBits(a.colour, b.colour) && sameBits(valuesOf(a), valuesOf(b));
}

std::string bytesOf(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::size_t filesIn(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), {}));
}

// The message of the Error that `act` throws, which is one line and has the code.
template <typename Act>
std::string lineOf(ExitCode code, Act&& act) {
  try {
    act();
  } catch (const Error& error) {
    const std::string line = error.what();
    CHECK(error.code() == code);
    CHECK(line.find('\n') == std::string::npos);
    return line;
  }
  return "(nothing was thrown)";
}

struct Folder : support::TemporaryFolder {
  Folder() : support::TemporaryFolder(fs::temp_directory_path(), "tessera-image-test") {}
  fs::path operator/(const char* name) const { return path() / name; }
};

// An .exr of another program: the named channels, all of one type.
void writeForeign(const fs::path& path, std::vector<std::string> names, OIIO::TypeDesc type, int tile = 0) {
  OIIO::ImageSpec spec(8, 8, static_cast<int>(names.size()), type);
  spec.channelnames = std::move(names);
  spec.tile_width = spec.tile_height = tile;
  const auto out = OIIO::ImageOutput::create(path.string());
  REQUIRE(out->open(path.string(), spec));
  const std::vector<float> values(8 * 8 * spec.channelnames.size(), 0.5f);
  REQUIRE(out->write_image(OIIO::TypeDesc::FLOAT, values.data()));
  REQUIRE(out->close());
}

struct Png {
  int width = 0, height = 0, channels = 0;
  std::vector<std::uint8_t> pixels;
};
Png readPng(const fs::path& path) {
  OIIO::ImageSpec unassociated;
  unassociated.attribute("oiio:UnassociatedAlpha", 1);
  OIIO::ImageSpec spec;
  const auto in = OIIO::ImageInput::create("png");
  REQUIRE(in->open(path.string(), spec, unassociated));
  Png png{spec.width, spec.height, spec.nchannels, {}};
  png.pixels.resize(static_cast<std::size_t>(png.width * png.height * png.channels));
  REQUIRE(spec.format == OIIO::TypeDesc::UINT8);
  REQUIRE(in->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT8, png.pixels.data()));
  return png;
}

}  // namespace

TEST_CASE("an exr round trip keeps every bit") {
  const Folder folder;
  for (const auto& [width, height] : {std::pair{1u, 1u}, {3u, 200u}, {257u, 65u}, {2000u, 1u}}) {
    for (const int parts : {kVisibility + 0, kHits + 0, kVisibility | kHits, kVisibility | kColour,
                            kVisibility | kAttribute, kVisibility | kHits | kColour | kAttribute}) {
      CAPTURE(width, height, parts);
      const Framebuffer frame = randomFrame(width, height, parts);
      writeImage(folder / "a.exr", frame);
      CHECK(sameBits(readImage(folder / "a.exr"), frame));
    }
  }
  CHECK(filesIn(folder.path()) == 1);  // written over each time, nothing left beside
}

TEST_CASE("an exr has the documented channels and types") {
  const Folder folder;
  writeImage(folder / "a.EXR", randomFrame(5, 4, kVisibility | kHits | kColour | kAttribute));
  const auto in = OIIO::ImageInput::open((folder / "a.EXR").string());
  REQUIRE(in);
  const OIIO::ImageSpec& spec = in->spec();
  CHECK(spec.get_string_attribute("compression") == "zip");
  CHECK(spec.nchannels == 7);
  for (const char* name : {"R", "G", "B", "Z", "A"})
    CHECK(spec.channelformat(spec.channelindex(name)) == OIIO::TypeDesc::FLOAT);
  for (const char* name : {"id", "hits"}) CHECK(spec.channelformat(spec.channelindex(name)) == OIIO::TypeDesc::UINT32);
}

TEST_CASE("the same frame gives the same file") {
  const Folder folder;
  const Framebuffer frame = randomFrame(64, 64, kVisibility | kColour);
  for (const char* name : {"a.exr", "b.exr", "a.png", "b.png"}) writeImage(folder / name, frame);
  CHECK(bytesOf(folder / "a.exr") == bytesOf(folder / "b.exr"));
  CHECK(bytesOf(folder / "a.png") == bytesOf(folder / "b.png"));
}

TEST_CASE("a png of colour is its sRGB") {
  const Folder folder;
  Framebuffer frame{.width = 4, .height = 1, .depth = {}, .ids = {}, .hits = {}, .colour = {}};
  frame.colour = {
      {0, 0.5f, 1}, {0.001f, 0.2158605f, 0.0512695f}, {-1, 2, std::numeric_limits<float>::quiet_NaN()}, {1, 1, 1}};
  writeImage(folder / "a.png", frame);
  const Png png = readPng(folder / "a.png");
  CHECK(png.channels == 3);
  CHECK(png.pixels == std::vector<std::uint8_t>{0, 188, 255, 3, 128, 64, 0, 255, 0, 255, 255, 255});
}

TEST_CASE("a png of hits goes from dark to light and an empty pixel is transparent") {
  const Folder folder;
  Framebuffer frame{.width = 6, .height = 1, .depth = {}, .ids = {}, .hits = {0, 1, 2, 4, 16, 64}, .colour = {}};
  writeImage(folder / "a.png", frame);
  const Png png = readPng(folder / "a.png");
  REQUIRE(png.channels == 4);
  CHECK(png.pixels[3] == 0);
  double before = -1;
  for (std::size_t k = 1; k < 6; ++k) {
    const std::uint8_t* p = &png.pixels[4 * k];
    CHECK(p[3] == 255);
    const double luma = 0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2];
    CHECK(luma > before + 10);
    before = luma;
  }
  CHECK(png.pixels[4 + 2] > png.pixels[4]);          // one hit: blue
  CHECK(png.pixels[20] > png.pixels[20 + 2] + 100);  // the most: yellow
}

TEST_CASE("a png of an attribute goes from blue to yellow over the range and an empty pixel is transparent") {
  const Folder folder;
  Framebuffer frame{.width = 4, .height = 1, .depth = {}, .ids = {}, .hits = {}, .colour = {}};
  frame.depth.assign(4, 0.5f);
  valuesOf(frame) = {-2, 0, 2, std::numeric_limits<float>::quiet_NaN()};
  const auto pixels = [&](const std::optional<ValueRange>& range) {
    writeImage(folder / "a.png", frame, range);
    const Png png = readPng(folder / "a.png");
    REQUIRE(png.channels == 4);
    return png.pixels;
  };
  const auto own = pixels({});
  CHECK(std::vector(own.begin() + 12, own.end()) == std::vector<std::uint8_t>{0, 0, 0, 0});
  CHECK(own[3] == 255);
  CHECK(own[2] > own[0] + 50);    // the least: blue
  CHECK(own[8] > own[10] + 100);  // the most: yellow
  CHECK(own == pixels(ValueRange{-2, 2}));
  CHECK(own != pixels(ValueRange{-2, 4}));
  // Beyond the range: the colour of its end. Turned round: the other way.
  const auto half = pixels(ValueRange{-2, 0}), turned = pixels(ValueRange{2, -2});
  CHECK(std::equal(half.begin() + 4, half.begin() + 8, half.begin() + 8));
  CHECK(std::equal(turned.begin(), turned.begin() + 4, own.begin() + 8));
  valuesOf(frame) = {3, 3, 3, 3};
  CHECK(pixels({})[3] == 255);  // no span
  frame.colour.assign(4, glm::vec3(1));
  writeImage(folder / "a.png", frame);
  CHECK(readPng(folder / "a.png").pixels == std::vector<std::uint8_t>(12, 255));  // shading comes first
}

TEST_CASE("a png of depth spans the depths of the frame and an empty pixel is transparent") {
  const Folder folder;
  Framebuffer frame{.width = 4,
                    .height = 1,
                    .depth = {0.9f, 0.95f, 1.0f, 1.0f},
                    .ids = {5, 0, 7, kNoTriangle},
                    .hits = {},
                    .colour = {}};
  writeImage(folder / "a.png", frame);
  CHECK(readPng(folder / "a.png").pixels ==
        std::vector<std::uint8_t>{240, 240, 240, 255, 140, 140, 140, 255, 40, 40, 40, 255, 0, 0, 0, 0});
  frame.ids.assign(4, kNoTriangle);
  frame.depth.assign(4, 1.0f);
  writeImage(folder / "a.png", frame);  // nothing drawn
  CHECK(readPng(folder / "a.png").pixels == std::vector<std::uint8_t>(16, 0));
}

TEST_CASE("names that cannot be written are refused before any work") {
  const Folder folder;
  const auto refusal = [&](const fs::path& path) {
    return lineOf(ExitCode::kUsage, [&] { ImageOutput output(path.string()); });
  };
  CHECK_THAT(refusal(folder / "a.jpg"), Contains("a.jpg") && Contains(".png or .exr"));
  CHECK_THAT(refusal(folder / "exr"), Contains(".png or .exr"));
  CHECK_THAT(refusal(folder / "no-folder/a.png"), Contains("no-folder does not exist"));
  std::ofstream(folder / "file") << "x";
  CHECK_THAT(refusal(folder / "file/a.png"), Contains("a.png: Not a directory"));
  fs::create_directory(folder / "folder.exr");
  CHECK_THAT(refusal(folder / "folder.exr"), Contains("is a folder"));
  CHECK_THAT(refusal("/proc/a.png"), Contains("/proc/a.png: ") && Contains("in /proc: "));
  CHECK_NOTHROW(ImageOutput((folder / "a.PNG").string()));
  CHECK(filesIn(folder.path()) == 2);  // asking leaves nothing behind
  CHECK_THAT(lineOf(ExitCode::kUsage, [&] { writeImage(folder / "a.jpg", randomFrame(2, 2, kVisibility)); }),
             Contains(".png or .exr"));
  CHECK_THAT(lineOf(ExitCode::kFailure, [&] { writeImage(folder / "a.exr", Framebuffer{}); }),
             Contains("nothing to write"));
}

TEST_CASE("a failed write leaves the old file as it was") {
  const Folder folder;
  writeImage(folder / "a.png", randomFrame(4, 4, kVisibility));
  const std::string before = bytesOf(folder / "a.png");
  Framebuffer impossible{
      .width = 2'000'000, .height = 1, .depth = {}, .ids = {}, .hits = {}, .colour = {}};  // PNG ends at 10^6
  impossible.hits.assign(impossible.pixels(), 1);
  CHECK_THAT(lineOf(ExitCode::kFailure, [&] { writeImage(folder / "a.png", impossible); }),
             Contains("a.png: could not be written: "));
  CHECK(bytesOf(folder / "a.png") == before);
  CHECK(filesIn(folder.path()) == 1);
}

TEST_CASE("files that cannot be read are refused in one line") {
  const Folder folder;
  const auto refusal = [&](const char* name) {
    const std::string line = lineOf(ExitCode::kUsage, [&] { readImage(folder / name); });
    CHECK_THAT(line, Contains(name));
    return line;
  };
  CHECK_THAT(refusal("missing.exr"), Contains("no such file"));
  CHECK_THAT(refusal("a.png"), Contains("only an .exr"));
  fs::create_directory(folder / "folder.exr");
  CHECK_THAT(refusal("folder.exr"), Contains("is a folder"));
  std::ofstream(folder / "empty.exr");
  CHECK_THAT(refusal("empty.exr"), Contains("not a whole OpenEXR file"));
  std::ofstream(folder / "text.exr") << "not an image\n";
  CHECK_THAT(refusal("text.exr"), Contains("not a whole OpenEXR file"));

  writeImage(folder / "whole.exr", randomFrame(100, 100, kVisibility));
  const std::string whole = bytesOf(folder / "whole.exr");
  for (const std::size_t length : {std::size_t{3}, std::size_t{100}, whole.size() / 2, whole.size() - 1}) {
    CAPTURE(length);
    std::ofstream(folder / "cut.exr", std::ios::binary) << whole.substr(0, length);
    CHECK_THAT(refusal("cut.exr"), Contains("not a whole OpenEXR file"));
  }
  // Another format under our extension, and other programs' files.
  writeImage(folder / "picture.png", randomFrame(8, 8, kVisibility));
  fs::rename(folder / "picture.png", folder / "picture.exr");
  CHECK_THAT(refusal("picture.exr"), Contains("not a whole OpenEXR file"));
  writeForeign(folder / "rgb.exr", {"R", "G", "B"}, OIIO::TypeDesc::HALF);
  CHECK_THAT(refusal("rgb.exr"), Contains("it should"));
  writeForeign(folder / "rgbf.exr", {"R", "G", "B"}, OIIO::TypeDesc::FLOAT);
  CHECK_THAT(refusal("rgbf.exr"), Contains("holds channels") && Contains("id and Z"));
  writeForeign(folder / "z.exr", {"Z"}, OIIO::TypeDesc::FLOAT);
  CHECK_THAT(refusal("z.exr"), Contains("id and Z"));
  writeForeign(folder / "floats.exr", {"Z", "id"}, OIIO::TypeDesc::FLOAT);
  CHECK_THAT(refusal("floats.exr"), Contains("channel id is float") && Contains("uint"));
  writeForeign(folder / "tiled.exr", {"Z"}, OIIO::TypeDesc::FLOAT, 16);
  CHECK_THAT(refusal("tiled.exr"), Contains("tiled"));
}

TEST_CASE("a broken header that asks for a vast raster is refused without its memory") {
  const Folder folder;
  writeImage(folder / "a.exr", randomFrame(16, 16, kVisibility));
  std::string bytes = bytesOf(folder / "a.exr");
  for (const char* window : {"dataWindow", "displayWindow"}) {
    const std::size_t at = bytes.find(window) + std::strlen(window) + 1 + std::strlen("box2i") + 1 + 4;
    const std::int32_t extent[4] = {0, 0, 30'000, 30'000};
    std::memcpy(&bytes[at], extent, sizeof extent);
  }
  std::ofstream(folder / "vast.exr", std::ios::binary) << bytes;
  CHECK_THAT(lineOf(ExitCode::kUsage, [&] { readImage(folder / "vast.exr"); }), Contains("vast.exr"));
}
