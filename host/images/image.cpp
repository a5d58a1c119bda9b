#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tessera/error.h>
#include <tessera/image.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <system_error>
#include <type_traits>
#include <utility>

#include "host/images/exr-header.h"
#include "host/images/image-module.h"
#include "host/images/picture.h"
#include "host/support/file-faults.h"
#include "host/support/files.h"

namespace tessera {
namespace {

namespace fs = std::filesystem;
using images::Format;

std::string extensionOf(const fs::path& path) {
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
  return extension;
}

constexpr std::size_t kValueBytes = 4;  // of every channel
constexpr std::size_t kBandBytes = std::size_t{16} << 20;
constexpr std::uint32_t kRowsOfChunk = 16;  // that zip packs together
constexpr std::string_view kLayer = "values.";

// A channel of an .exr and where its values lie in a framebuffer.
template <typename Byte>
struct FileChannel {
  std::string name;
  const char* type;
  Byte* data;          ///< of pixel 0
  std::size_t stride;  ///< bytes from pixel to pixel
};

// Whether the framebuffer's further channels are one of one float, which the file calls A.
bool isAlone(const std::vector<Channel>& channels) {
  return channels.size() == 1 && channels[0].components == 1 && channels[0].type() == ChannelType::kFloat32;
}

template <typename Frame>
auto channelsOf(Frame& frame) {
  using Byte = std::conditional_t<std::is_const_v<Frame>, const std::byte, std::byte>;
  std::vector<FileChannel<Byte>> channels;
  const auto add = [&](std::string name, const char* type, auto& values, std::size_t offset, std::size_t stride) {
    if (!values.empty())
      channels.push_back({std::move(name), type, reinterpret_cast<Byte*>(values.data()) + offset, stride});
  };
  add("R", "float", frame.colour, 0, 12);
  add("G", "float", frame.colour, 4, 12);
  add("B", "float", frame.colour, 8, 12);
  add("Z", "float", frame.depth, 0, kValueBytes);
  for (auto& channel : frame.channels)
    std::visit(
        [&](auto& values) {
          const char* const type = channel.type() == ChannelType::kFloat32 ? "float" : "uint";
          for (unsigned c = 0; c < channel.components; ++c) {
            const std::string part = channel.components == 1 ? "" : std::string(".") + "xyzw"[c];
            add(isAlone(frame.channels) ? "A" : std::string(kLayer) + channel.name + part, type, values,
                kValueBytes * c, kValueBytes * channel.components);
          }
        },
        channel.data);
  add("id", "uint", frame.ids, 0, kValueBytes);
  add("hits", "uint", frame.hits, 0, kValueBytes);
  return channels;
}

images::Header pngHeader(std::uint32_t width, std::uint32_t height, int channels, const ImageFacts& facts) {
  images::Header header{width, height, {}, facts};
  for (int c = 0; c < channels; ++c) header.channels.push_back({{}, "uint8", 1});
  return header;
}

// The format that stands before a name, and the name after it; nothing where none stands there.
std::pair<std::optional<Format>, std::string> splitName(const std::string& name) {
  if (name.starts_with("png:")) return {Format::kPng, name.substr(4)};
  if (name.starts_with("exr:")) return {Format::kExr, name.substr(4)};
  return {{}, name};
}

Format formatOf(const std::string& name) {
  const auto [format, path] = splitName(name);
  if (format) return *format;
  const std::string extension = extensionOf(path);
  if (extension == ".png") return Format::kPng;
  if (extension == ".exr") return Format::kExr;
  failUsage(
      fmt::format("{}: unknown image format '{}'; the name should end in .png or .exr, or begin with png: or exr: "
                  "as in png:-",
                  name, extension));
}

}  // namespace

struct ImageOutput::State {
  Format format;
  fs::path path;
  support::OutputFile file;

  explicit State(const std::string& name) : format(formatOf(name)), path(splitName(name).second), file(path) {}

  void write(const images::Header& header, const images::RowSource& rows) {
    const std::string why = images::imageModule().write(file.path().string(), format, header, rows);
    if (!why.empty()) fail(fmt::format("{}: could not be written: {}", path.string(), file.whyNotWhole(why)));
    file.commit();
  }
};

ImageOutput::ImageOutput(const std::string& name) : state_(std::make_unique<State>(name)) {}
ImageOutput::~ImageOutput() = default;
ImageOutput::ImageOutput(ImageOutput&&) noexcept = default;
const fs::path& ImageOutput::path() const { return state_->path; }

void ImageOutput::write(const Framebuffer& frame, const std::optional<ValueRange>& range, const ImageFacts& facts) {
  const auto channels = channelsOf(frame);
  if (channels.empty()) fail(fmt::format("{}: the frame holds nothing to write", path().string()));
  if (state_->format == Format::kPng) {
    const images::Picture picture = images::makePicture(frame, range);
    state_->write(pngHeader(frame.width, frame.height, picture.channels, facts),
                  [&](std::uint32_t begin, std::uint32_t end, std::byte* out) {
                    picture.pixels(std::size_t{begin} * frame.width, std::size_t{end} * frame.width,
                                   reinterpret_cast<std::uint8_t*>(out));
                  });
    return;
  }
  images::Header header{frame.width, frame.height, {}, facts};
  for (const auto& channel : channels) header.channels.push_back({channel.name, channel.type, kValueBytes});
  state_->write(header, [&](std::uint32_t begin, std::uint32_t end, std::byte* out) {
    for (std::size_t k = std::size_t{begin} * frame.width; k < std::size_t{end} * frame.width; ++k) {
      for (const auto& channel : channels) {
        std::memcpy(out, channel.data + k * channel.stride, kValueBytes);
        out += kValueBytes;
      }
    }
  });
}

void ImageOutput::write(std::uint32_t width, std::uint32_t height, const ColourRows& rows, const ImageFacts& facts) {
  std::vector<glm::vec3> colours;
  const auto make = [&](std::uint32_t begin, std::uint32_t end) {
    colours.resize(std::size_t{end - begin} * width);
    rows(begin, end, colours.data());
  };
  if (state_->format == Format::kPng) {
    state_->write(pngHeader(width, height, 3, facts), [&](std::uint32_t begin, std::uint32_t end, std::byte* out) {
      make(begin, end);
      auto* next = reinterpret_cast<std::uint8_t*>(out);
      for (const glm::vec3& colour : colours) next = images::putSrgb(colour, next);
    });
    return;
  }
  images::Header header{width, height, {}, facts};
  for (const char* name : {"R", "G", "B"}) header.channels.push_back({name, "float", kValueBytes});
  state_->write(header, [&](std::uint32_t begin, std::uint32_t end, std::byte* out) {
    make(begin, end);
    std::memcpy(out, colours.data(), colours.size() * sizeof(glm::vec3));
  });
}

void writeImage(const fs::path& path, const Framebuffer& frame, const std::optional<ValueRange>& range,
                const ImageFacts& facts) {
  ImageOutput(path.string()).write(frame, range, facts);
}

struct ImageReader::State {
  std::string name;
  std::unique_ptr<images::Reader> file;
  std::vector<std::byte> rows;
  std::size_t pixelBytes = 0;
  bool ids = false, depth = false, hits = false, colour = false;
  std::vector<Channel> channels;  // without values

  // Those of the file beside ids, depth, hits and colour.
  std::vector<Channel> furtherChannels() const;
  // Where a channel lies in a pixel.
  std::size_t offsetOf(std::string_view channel) const {
    std::size_t offset = 0;
    for (const auto& c : file->header().channels) {
      if (c.name == channel) break;
      offset += c.bytes;
    }
    return offset;
  }
  // Whether the file has the channel. Throws if it has another type.
  bool has(std::string_view channel, std::string_view type) const {
    for (const auto& c : file->header().channels) {
      if (c.name != channel) continue;
      if (c.type != type) failUsage(fmt::format("{}: channel {} is {}, it should be {}", name, channel, c.type, type));
      return true;
    }
    return false;
  }
};

std::vector<Channel> ImageReader::State::furtherChannels() const {
  const auto named = [this](const std::string& name) {
    return std::ranges::any_of(file->header().channels, [&](const auto& c) { return c.name == name; });
  };
  const auto text = std::ranges::find(file->header().text, "attribute", [](const auto& fact) { return fact.first; });
  if (has("A", "float")) return {{text == file->header().text.end() ? "A" : text->second, 1, {}}};
  Framebuffer made;
  for (const auto& c : file->header().channels) {
    if (!c.name.starts_with(kLayer)) continue;
    std::string name = c.name.substr(kLayer.size());
    unsigned components = 1;
    // The x of NAME.x, NAME.y ... stands for them all.
    const std::string stem = name.substr(0, name.size() - std::min<std::size_t>(name.size(), 2));
    const auto part = [&](char letter) { return std::string(kLayer) + stem + '.' + letter; };
    if (named(part('x')) && named(part('y'))) {
      if (c.name != part('x') && std::string_view("yzw").find(name.back()) != std::string_view::npos) continue;
      if (c.name == part('x')) name = stem, components = named(part('w')) ? 4 : named(part('z')) ? 3 : 2;
    }
    made.makeChannel(name, c.type == "uint" ? ChannelType::kUint32 : ChannelType::kFloat32, components);
  }
  return made.channels;
}

ImageReader::ImageReader(const fs::path& path, std::uint64_t limit) : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.name = path.string();
  if (extensionOf(path) != ".exr") failUsage(fmt::format("{}: only an .exr holds ids and depth", s.name));
  // Read twice, from its beginning: a pipe will not do.
  if (const std::string why = support::whyNoFile(path); !why.empty()) failUsage(fmt::format("{}: {}", s.name, why));
  images::checkExr(path, limit);
  std::string why;
  s.file = images::imageModule().openExr(s.name, why);
  if (!s.file) failUsage(fmt::format("{}: not a whole OpenEXR file: {}", s.name, why));
  s.ids = s.has("id", "uint");
  s.depth = s.has("Z", "float");
  s.hits = s.has("hits", "uint");
  s.channels = s.furtherChannels();
  const bool red = s.has("R", "float"), green = s.has("G", "float"), blue = s.has("B", "float");
  s.colour = red && green && blue;
  if ((!s.ids || !s.depth) && !s.hits) {
    std::vector<std::string> found;
    for (const auto& channel : s.file->header().channels) found.push_back(channel.name);
    failUsage(fmt::format("{}: holds channels {}; it should hold id and Z, or hits", s.name, fmt::join(found, ", ")));
  }
  for (const auto& channel : s.file->header().channels) s.pixelBytes += channel.bytes;
}

ImageReader::~ImageReader() = default;
std::uint32_t ImageReader::width() const { return state_->file->header().width; }
std::uint32_t ImageReader::height() const { return state_->file->header().height; }
const ImageFacts& ImageReader::facts() const { return state_->file->header().text; }

std::uint32_t ImageReader::bandRows() const {
  const std::size_t row = std::size_t{width()} * state_->pixelBytes;
  return static_cast<std::uint32_t>(std::clamp<std::size_t>(kBandBytes / row, 1, 4) * kRowsOfChunk);
}

void ImageReader::read(std::uint32_t begin, std::uint32_t end, Framebuffer& band) {
  State& s = *state_;
  band.width = width();
  band.height = end - begin;
  s.rows.resize(band.pixels() * s.pixelBytes);
  const std::string why = s.file->read(begin, end, s.rows.data());
  if (!why.empty()) failUsage(fmt::format("{}: not a whole OpenEXR file: {}", s.name, why));
  band.ids.resize(s.ids ? band.pixels() : 0);
  band.depth.resize(s.depth ? band.pixels() : 0);
  band.hits.resize(s.hits ? band.pixels() : 0);
  band.channels = s.channels;
  for (Channel& c : band.channels)
    std::visit([&](auto& values) { values.resize(c.components * band.pixels()); }, c.data);
  band.colour.resize(s.colour ? band.pixels() : 0);
  for (const auto& channel : channelsOf(band)) {
    const std::byte* from = s.rows.data() + s.offsetOf(channel.name);
    for (std::size_t k = 0; k < band.pixels(); ++k, from += s.pixelBytes)
      std::memcpy(channel.data + k * channel.stride, from, kValueBytes);
  }
}

Framebuffer readImage(const fs::path& path, std::uint64_t limit) {
  ImageReader reader(path, limit);
  Framebuffer frame, band;
  frame.width = reader.width();
  frame.height = reader.height();
  const auto add = [&](auto& to, const auto& from) {
    if (to.empty() && !from.empty()) to.reserve(frame.pixels());  // taken as it is filled
    to.insert(to.end(), from.begin(), from.end());
  };
  for (std::uint32_t begin = 0; begin < frame.height; begin += reader.bandRows()) {
    reader.read(begin, std::min(frame.height, begin + reader.bandRows()), band);
    add(frame.ids, band.ids);
    add(frame.depth, band.depth);
    add(frame.hits, band.hits);
    for (const Channel& from : band.channels)
      std::visit(
          [&]<typename T>(const std::vector<T>& values) {
            add(std::get<std::vector<T>>(frame.makeChannel(from.name, from.type(), from.components).data), values);
          },
          from.data);
    add(frame.colour, band.colour);
  }
  return frame;
}

}  // namespace tessera
