#include "host/support/terminal.h"

#include <algorithm>
#include <cstdint>

namespace tessera::support {
namespace {

/// Length and value of the character that begins there; length 0 where the bytes are not UTF-8 (RFC 3629).
std::pair<std::size_t, std::uint32_t> characterAt(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i])); };
  const std::uint32_t first = byte(at);
  if (first < 0x80) return {1, first};
  const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || at + length > text.size()) return {0, 0};
  std::uint32_t value = first & (0x7fu >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(at + i) & 0xc0) != 0x80) return {0, 0};
    value = value << 6 | (byte(at + i) & 0x3f);
  }
  const std::uint32_t least = length == 4 ? 0x10000 : length == 3 ? 0x800 : 0x80;
  const bool isSurrogate = value >= 0xd800 && value <= 0xdfff;
  return value < least || value > 0x10ffff || isSurrogate ? std::pair<std::size_t, std::uint32_t>{0, 0}
                                                          : std::pair{length, value};
}

bool isObeyed(std::uint32_t c) {
  if (c == '\n' || c == '\t') return false;
  return c < 0x20 || (c >= 0x7f && c < 0xa0)                              // C0, DEL, C1
         || c == 0x61c || c == 0x200e || c == 0x200f                      // marks of direction
         || (c >= 0x2028 && c <= 0x202e) || (c >= 0x2066 && c <= 0x2069)  // ends of lines, overrides, isolates
         || c == 0xfeff || c == 0xfffe || c == 0xffff;                    // a mark of the order of bytes, no characters
}

}  // namespace

std::string visible(std::string_view text) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const auto [length, c] = characterAt(text, at);
    if (length == 0)
      result += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[at]));
    else if (isObeyed(c))
      result += fmt::format("\\u{:04x}", c);
    else
      result += text.substr(at, length);
    at += std::max<std::size_t>(length, 1);
  }
  return result;
}

}  // namespace tessera::support
