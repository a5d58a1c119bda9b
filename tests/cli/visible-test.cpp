// What a terminal would obey is written out, in the command as in the report.
#include <catch2/catch.hpp>
#include <charconv>
#include <fstream>

#include "host/support/terminal.h"
#include "run-tessera.h"

using tessera::support::visible;
using tessera::test::Desk;

namespace {

std::string bytesOf(const std::string& hex) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2) {
    unsigned byte = 0;
    std::from_chars(&hex[i], &hex[i] + 2, byte, 16);
    bytes += static_cast<char>(byte);
  }
  return bytes;
}

/// UTF-8 (RFC 3629).
std::string bytesOf(std::uint32_t c) {
  if (c < 0x80) return {static_cast<char>(c)};
  std::string bytes;
  for (; c >= (bytes.empty() ? 0x40u : 0x40u >> bytes.size()); c >>= 6)
    bytes.insert(bytes.begin(), static_cast<char>(0x80 | (c & 0x3f)));
  bytes.insert(bytes.begin(), static_cast<char>((0xffu << (7 - bytes.size()) & 0xff) | c));
  return bytes;
}

}  // namespace

TEST_CASE("Text for a terminal is as the table has it that the report shares") {
  std::ifstream table(TESSERA_SOURCE_DIR "/tests/cli/visible.txt");
  std::size_t cases = 0;
  for (std::string line; std::getline(table, line);) {
    if (line.starts_with('#')) continue;
    const std::size_t tab = line.find('\t');
    REQUIRE(tab != std::string::npos);
    INFO(line);
    CHECK(visible(bytesOf(line.substr(0, tab))) == line.substr(tab + 1));
    ++cases;
  }
  CHECK(cases > 40);
  CHECK(visible("a\tb\nc") == "a\tb\nc");
  CHECK(visible("").empty());
}

TEST_CASE("Of all characters eighty are written out") {
  std::size_t written = 0;
  for (std::uint32_t c = 0; c <= 0x10ffff; ++c) {
    if (c >= 0xd800 && c <= 0xdfff) continue;
    const std::string text = bytesOf(c);
    written += visible(text) != text;
  }
  CHECK(written == 80);
}

TEST_CASE("Completion does not pass on what a terminal obeys") {
  const Desk desk;
  const auto outcome = desk.tessera("complete -- render --device \"$(printf '\\033]0;x\\007,')\"");
  INFO(outcome.out << outcome.err);
  CHECK(outcome.code == 0);
  CHECK(outcome.out.find("\\u001b]0;x\\u0007,cpu\t") != std::string::npos);
  CHECK(outcome.out.find('\033') == std::string::npos);
}
