#include "host/image.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <fstream>
#include <string>
#include <system_error>
#include <type_traits>

#include "host/error.h"
#include "host/files.h"
#include "host/picture.h"
#include "host/scene.h"

namespace tessera {
namespace {

namespace fs = std::filesystem;
using OIIO::TypeDesc;

std::string extensionOf(const fs::path& path) {
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
  return extension;
}

fs::path folderOf(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

// OpenImageIO's messages may run over several lines.
std::string firstLine(const std::string& text) { return text.substr(0, text.find('\n')); }

// A channel of an .exr and where its values lie in a framebuffer. All are 4 bytes wide.
constexpr std::size_t kChannelBytes = 4;
template <typename Byte>
struct Channel {
  const char* name;
  TypeDesc::BASETYPE type;
  Byte* data;          ///< of pixel 0
  std::size_t stride;  ///< bytes from pixel to pixel
};

template <typename Frame>
auto channelsOf(Frame& frame) {
  using Byte = std::conditional_t<std::is_const_v<Frame>, const std::byte, std::byte>;
  std::vector<Channel<Byte>> channels;
  const auto add = [&](const char* name, TypeDesc::BASETYPE type, auto& values, std::size_t offset) {
    if (values.empty()) return;
    channels.push_back({name, type, reinterpret_cast<Byte*>(values.data()) + offset, sizeof(values[0])});
  };
  add("R", TypeDesc::FLOAT, frame.colour, 0);
  add("G", TypeDesc::FLOAT, frame.colour, 4);
  add("B", TypeDesc::FLOAT, frame.colour, 8);
  add("Z", TypeDesc::FLOAT, frame.depth, 0);
  add("A", TypeDesc::FLOAT, frame.attribute, 0);
  add("id", TypeDesc::UINT32, frame.ids, 0);
  add("hits", TypeDesc::UINT32, frame.hits, 0);
  return channels;
}

constexpr std::uint32_t kRowsAtATime = 64;  // a multiple of the 16 rows that are compressed together

bool writeExr(OIIO::ImageOutput& out, const std::string& name, const Framebuffer& frame) {
  const auto channels = channelsOf(frame);
  OIIO::ImageSpec spec(static_cast<int>(frame.width), static_cast<int>(frame.height), static_cast<int>(channels.size()),
                       TypeDesc::FLOAT);
  spec.channelformats.resize(channels.size());
  for (std::size_t c = 0; c < channels.size(); ++c) {
    spec.channelnames[c] = channels[c].name;
    spec.channelformats[c] = channels[c].type;
  }
  spec.attribute("compression", "zip");
  if (!out.open(name, spec)) return false;
  std::vector<std::byte> rows;
  for (std::uint32_t begin = 0; begin < frame.height; begin += kRowsAtATime) {
    const std::uint32_t end = std::min(frame.height, begin + kRowsAtATime);
    rows.resize(std::size_t{end - begin} * frame.width * channels.size() * kChannelBytes);
    std::byte* next = rows.data();
    for (std::size_t k = std::size_t{begin} * frame.width; k < std::size_t{end} * frame.width; ++k) {
      for (const auto& channel : channels) {
        std::memcpy(next, channel.data + k * channel.stride, kChannelBytes);
        next += kChannelBytes;
      }
    }
    if (!out.write_scanlines(static_cast<int>(begin), static_cast<int>(end), 0, TypeDesc::UNKNOWN, rows.data()))
      return false;
  }
  return out.close();
}

bool writePng(OIIO::ImageOutput& out, const std::string& name, const Framebuffer& frame,
              const std::optional<ValueRange>& range) {
  const Picture picture = makePicture(frame, range);
  OIIO::ImageSpec spec(static_cast<int>(frame.width), static_cast<int>(frame.height), picture.channels,
                       TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  spec.attribute("oiio:UnassociatedAlpha", 1);  // as PNG has it: nothing is multiplied or divided by alpha
  return out.open(name, spec) && out.write_image(TypeDesc::UINT8, picture.pixels.data()) && out.close();
}

// Number of a channel in the file, -1 where the file lacks it. Throws if it has another type.
int channelOf(const OIIO::ImageSpec& spec, const std::string& file, const char* name, TypeDesc type) {
  const int c = spec.channelindex(name);
  if (c >= 0 && spec.channelformat(c) != type) {
    failUsage(
        fmt::format("{}: channel {} is {}, it should be {}", file, name, spec.channelformat(c).c_str(), type.c_str()));
  }
  return c;
}

}  // namespace

void checkImagePath(const fs::path& path) {
  const std::string extension = extensionOf(path);
  if (extension != ".png" && extension != ".exr") {
    failUsage(
        fmt::format("{}: unknown image format '{}'; the name should end in .png or .exr", path.string(), extension));
  }
  std::error_code error;
  const fs::path folder = folderOf(path);
  if (!fs::is_directory(folder, error))
    failUsage(fmt::format("{}: there is no folder {}", path.string(), folder.string()));
  if (fs::is_directory(path, error)) failUsage(fmt::format("{}: is a folder, not an image file", path.string()));
  // Asking for permissions misses read-only and special file systems; making a file does not.
  const fs::path probe = folder / uniqueName(path.filename().string());
  errno = 0;
  const bool made = std::ofstream(probe).is_open();
  const int cause = errno;
  fs::remove(probe, error);
  if (!made) {
    failUsage(fmt::format("{}: cannot write into {}: {}", path.string(), folder.string(),
                          std::generic_category().message(cause)));
  }
}

void writeImage(const fs::path& path, const Framebuffer& frame, const std::optional<ValueRange>& range) {
  checkImagePath(path);
  if (channelsOf(frame).empty()) fail(fmt::format("{}: the frame holds nothing to write", path.string()));
  const bool exr = extensionOf(path) == ".exr";
  const fs::path beside = folderOf(path) / uniqueName(path.filename().string());
  const auto out = OIIO::ImageOutput::create(exr ? "openexr" : "png");
  if (!out) fail(fmt::format("{}: {}", path.string(), firstLine(OIIO::geterror())));
  std::error_code error;
  if (!(exr ? writeExr(*out, beside.string(), frame) : writePng(*out, beside.string(), frame, range))) {
    const std::string why = firstLine(out->geterror());
    fs::remove(beside, error);
    fail(fmt::format("{}: cannot be written: {}", path.string(), why));
  }
  fs::rename(beside, path, error);
  if (error) {
    const std::string why = error.message();
    fs::remove(beside, error);
    fail(fmt::format("{}: cannot be written: {}", path.string(), why));
  }
}

Framebuffer readImage(const fs::path& path) {
  const std::string name = path.string();
  std::error_code error;
  if (extensionOf(path) != ".exr") failUsage(fmt::format("{}: only an .exr holds ids and depth", name));
  if (!fs::exists(path, error)) failUsage(fmt::format("{}: no such file", name));
  if (fs::is_directory(path, error)) failUsage(fmt::format("{}: is a folder, not an image file", name));
  // By the format's name: OpenImageIO would else try all its other readers on a broken file.
  const auto in = OIIO::ImageInput::create("openexr");
  if (!in) fail(fmt::format("{}: {}", name, firstLine(OIIO::geterror())));
  const auto failBroken = [&] {
    failUsage(fmt::format("{}: not a whole OpenEXR file: {}", name, firstLine(in->geterror())));
  };
  OIIO::ImageSpec spec;
  if (!in->open(name, spec)) failBroken();
  if (spec.deep || spec.tile_width != 0)
    failUsage(fmt::format("{}: is deep or tiled, it should have plain scanlines", name));
  if (spec.width < 1 || spec.height < 1 || spec.width > static_cast<int>(kMaxExtent) ||
      spec.height > static_cast<int>(kMaxExtent)) {
    failUsage(fmt::format("{}: is {} x {} pixels, it should be 1 x 1 to {} x {}", name, spec.width, spec.height,
                          kMaxExtent, kMaxExtent));
  }

  const int id = channelOf(spec, name, "id", TypeDesc::UINT32), z = channelOf(spec, name, "Z", TypeDesc::FLOAT);
  const int hits = channelOf(spec, name, "hits", TypeDesc::UINT32);
  const int attribute = channelOf(spec, name, "A", TypeDesc::FLOAT);
  const bool shaded = channelOf(spec, name, "R", TypeDesc::FLOAT) >= 0 &&
                      channelOf(spec, name, "G", TypeDesc::FLOAT) >= 0 &&
                      channelOf(spec, name, "B", TypeDesc::FLOAT) >= 0;
  if ((id < 0 || z < 0) && hits < 0) {
    std::string found = fmt::format("{}", fmt::join(spec.channelnames, ", "));
    failUsage(fmt::format("{}: holds channels {}; it should hold id and Z, or hits", name, found));
  }

  Framebuffer frame;
  frame.width = static_cast<std::uint32_t>(spec.width);
  frame.height = static_cast<std::uint32_t>(spec.height);
  const std::size_t pixelBytes = spec.pixel_bytes(true);
  std::vector<std::byte> rows;
  for (std::uint32_t begin = 0; begin < frame.height; begin += kRowsAtATime) {
    // The framebuffer grows with what was read, so that a broken header cannot ask for all memory.
    const std::uint32_t end = std::min(frame.height, begin + kRowsAtATime);
    const std::size_t before = std::size_t{begin} * frame.width, after = std::size_t{end} * frame.width;
    rows.resize((after - before) * pixelBytes);
    const int y = spec.y + static_cast<int>(begin);
    const int yEnd = y + static_cast<int>(end - begin);
    if (!in->read_scanlines(0, 0, y, yEnd, 0, 0, spec.nchannels, TypeDesc::UNKNOWN, rows.data())) failBroken();
    if (id >= 0) frame.ids.resize(after);
    if (z >= 0) frame.depth.resize(after);
    if (hits >= 0) frame.hits.resize(after);
    if (attribute >= 0) frame.attribute.resize(after);
    if (shaded) frame.colour.resize(after);
    for (const auto& channel : channelsOf(frame)) {
      const std::byte* from = rows.data() + spec.pixel_bytes(0, spec.channelindex(channel.name), true);
      for (std::size_t k = before; k < after; ++k, from += pixelBytes) {
        std::memcpy(channel.data + k * channel.stride, from, kChannelBytes);
      }
    }
  }
  return frame;
}

}  // namespace tessera
