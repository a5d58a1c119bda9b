#include "host/images/exr-header.h"

#include <fmt/format.h>
#include <tessera/error.h>
#include <tessera/scene.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>
#include <string>

#include "host/support/file-faults.h"

namespace tessera::images {
namespace {

namespace fs = std::filesystem;

// "OpenEXR File Layout", https://openexr.com/en/latest/OpenEXRFileLayout.html. Numbers are little-endian.
constexpr std::uint32_t kMagic = 20000630;
enum Flags : std::uint32_t { kTiled = 0x200, kDeep = 0x800, kMultiPart = 0x1000 };
constexpr std::uint64_t kLeastLimit = std::uint64_t{512} << 20;
constexpr std::uint64_t kMostPacked = 1100;
constexpr std::int64_t kFarthest = 1 << 24;  // of a window from 0, so that no sum in a library overflows
constexpr std::size_t kLongestName = 255;
// Rows that are packed together, by the number of the compression: none, rle, zips, zip, piz, pxr24, b44, b44a, dwaa,
// dwab.
constexpr std::array<std::uint64_t, 10> kRowsOfChunk{1, 1, 1, 16, 32, 16, 32, 32, 32, 256};

struct Box {
  std::array<std::int32_t, 4> at;  // xMin, yMin, xMax, yMax
  std::int64_t width() const { return std::int64_t{at[2]} - at[0] + 1; }
  std::int64_t height() const { return std::int64_t{at[3]} - at[1] + 1; }
};

class Header {
 public:
  explicit Header(const fs::path& path) : name_(path.string()), file_(path, std::ios::binary | std::ios::ate) {
    if (!file_)
      throw Error(support::codeOf(errno), fmt::format("{}: cannot be opened: {}", name_, std::strerror(errno)));
    bytes_ = static_cast<std::uint64_t>(file_.tellg());
    file_.seekg(0);
    if (number<std::uint32_t>() != kMagic) broken("it does not begin as one");
    const auto flags = number<std::uint32_t>();
    if (flags & (kDeep | kTiled)) failUsage(fmt::format("{}: is deep or tiled, it should have plain scanlines", name_));
    if (flags & kMultiPart) failUsage(fmt::format("{}: has several parts, it should have one", name_));
    for (std::string attribute = text(); !attribute.empty(); attribute = text()) readAttribute(attribute);
  }

  void check(std::uint64_t limit) {
    if (!data_) broken("it has no data window");
    if (!display_) broken("it has no display window");
    if (!channels_) broken("it has no channels");
    const auto extent = [](std::int64_t pixels) { return pixels >= 1 && pixels <= kMaxExtent; };
    for (const auto& [box, what] : {std::pair{*data_, ""}, {*display_, " in its display window"}}) {
      if (!extent(box.width()) || !extent(box.height()))
        failUsage(fmt::format("{}: is {} x {} pixels{}, it should be 1 x 1 to {} x {}", name_, box.width(),
                              box.height(), what, kMaxExtent, kMaxExtent));
      for (const std::int64_t at : box.at)
        if (at < -kFarthest || at > kFarthest)
          failUsage(fmt::format("{}: its pixels begin at ({}, {}), they should begin within {} of 0", name_, box.at[0],
                                box.at[1], kFarthest));
    }
    const auto width = static_cast<std::uint64_t>(data_->width()), height = static_cast<std::uint64_t>(data_->height());
    // A library holds some chunks at a time.
    const std::uint64_t asked = std::max(height, 8 * rowsOfChunk_) * width * pixelBytes_;
    const std::uint64_t allowed = limit ? limit : std::max(kLeastLimit, kMostPacked * bytes_);
    if (asked > allowed)
      failUsage(
          fmt::format("{}: {} x {} pixels of {} channels unpack to {} MiB from a file of {} KiB, the limit is {} MiB; "
                      "--max-unpacked raises it",
                      name_, width, height, channels_, (asked >> 20) + 1, (bytes_ >> 10) + 1, allowed >> 20));
  }

 private:
  [[noreturn]] void broken(const std::string& why) const {
    failUsage(fmt::format("{}: not a whole OpenEXR file: {}", name_, why));
  }
  std::uint64_t left() { return bytes_ - static_cast<std::uint64_t>(file_.tellg()); }
  void read(void* to, std::size_t bytes) {
    if (left() < bytes || !file_.read(static_cast<char*>(to), static_cast<std::streamsize>(bytes)))
      broken("it ends within its header");
  }
  template <typename T>
  T number() {
    T value;
    read(&value, sizeof value);
    return value;
  }
  std::string text() {
    std::string found;
    for (char c = number<char>(); c != 0; c = number<char>()) {
      if (found.size() == kLongestName) broken("a name in its header has no end");
      found += c;
    }
    return found;
  }

  void readAttribute(const std::string& attribute) {
    const std::string type = text();
    const auto size = number<std::int32_t>();
    if (size < 0 || static_cast<std::uint64_t>(size) > left())
      broken(fmt::format("its attribute {} has {} bytes, which the file has not", attribute, size));
    const std::streampos end = file_.tellg() + std::streamoff{size};
    if (attribute == "dataWindow") data_ = number<Box>();
    if (attribute == "displayWindow") display_ = number<Box>();
    if (attribute == "channels") readChannels();
    if (attribute == "compression") {
      const auto compression = number<std::uint8_t>();
      if (compression >= kRowsOfChunk.size())
        failUsage(fmt::format("{}: is packed in way {}, which is unknown; zip would be right", name_, compression));
      rowsOfChunk_ = kRowsOfChunk[compression];
    }
    if (attribute == "type") {
      std::string kind(static_cast<std::size_t>(size), 0);
      read(kind.data(), kind.size());
      if (kind != "scanlineimage")
        failUsage(fmt::format("{}: is of type '{}', it should be scanlineimage", name_, kind.substr(0, 40)));
    }
    file_.seekg(end);
  }

  void readChannels() {
    for (std::string channel = text(); !channel.empty(); channel = text()) {
      const auto type = number<std::uint32_t>();
      number<std::uint32_t>();  // whether values are perceptually linear, and reserved bytes
      const auto x = number<std::int32_t>(), y = number<std::int32_t>();
      if (type > 2) broken(fmt::format("its channel {} has type {}", channel, type));
      if (x != 1 || y != 1) failUsage(fmt::format("{}: channel {} has not a value a pixel, it should", name_, channel));
      pixelBytes_ += type == 1 ? 2 : 4;
      ++channels_;
    }
  }

  std::string name_;
  std::ifstream file_;
  std::uint64_t bytes_ = 0, pixelBytes_ = 0, channels_ = 0, rowsOfChunk_ = 1;
  std::optional<Box> data_, display_;
};

}  // namespace

void checkExr(const fs::path& path, std::uint64_t limit) { Header(path).check(limit); }

}  // namespace tessera::images
