// What the library asks of libtessera-image-io.so, which alone is linked with OpenImageIO: 260 shared libraries that a
// command without an image does not wait for. Texts are returned, not thrown: empty is good, else one line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace tessera::images {

enum class Format { kPng, kExr };

struct Channel {
  std::string name, type;  ///< "float", "uint", or what a foreign file has; a .png's are "uint8"
  std::size_t bytes = 4;
};

/// What a file says about its pixels. Row 0 is at the top.
struct Header {
  std::uint32_t width = 0, height = 0;
  std::vector<Channel> channels;
  std::vector<std::pair<std::string, std::string>> text;  ///< what the image depends on, by name
};

/// Gives the rows from `begin` up to `end`, pixel by pixel, channel by channel.
using RowSource = std::function<void(std::uint32_t begin, std::uint32_t end, std::byte* pixels)>;

/// An open .exr.
class Reader {
 public:
  virtual ~Reader() = default;
  virtual const Header& header() const = 0;
  /// Any rows, as RowSource gives them, in the order of the header's channels.
  virtual std::string read(std::uint32_t begin, std::uint32_t end, std::byte* pixels) = 0;
};

struct Module {
  const char* version;
  /// Writes the file, reads it back and compares: an image that a full disk cut short is an error.
  std::string (*write)(const std::string& file, Format format, const Header& header, const RowSource& rows);
  /// Null and a text in `error` where it cannot be read.
  std::unique_ptr<Reader> (*openExr)(const std::string& file, std::string& error);
};

/// The module's one symbol, of type `const Module* ()`.
inline constexpr char kEntry[] = "tesseraImageIo";

}  // namespace tessera::images
