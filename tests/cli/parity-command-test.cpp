// parity where every device is wrong alike: the stage is named by a variant that is right, and the replay is what still
// differs.
#include <catch2/catch.hpp>
#include <filesystem>
#include <regex>

#include "run-tessera.h"

using namespace tessera::test;
namespace fs = std::filesystem;

namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// A file of the kernels' sources with one place changed.
std::string changed(const Desk& desk, const std::string& file, const std::string& from, const std::string& to) {
  fs::copy_file(fs::path(TESSERA_SOURCE_DIR) / "slang" / file, desk.path() / "source",
                fs::copy_options::overwrite_existing);
  std::string text = desk.read("source");
  fs::remove(desk.path() / "source");
  REQUIRE(has(text, from));
  return text.replace(text.find(from), from.size(), to);
}

/// What parity said it wrote: the file, how many triangles, and the command.
std::smatch replayIn(const std::string& said) {
  static const std::regex wrote(
      R"(wrote (\S+): ([\d,]+) of ([\d,]+) triangles( \(none can be left out\))?, which show it again: tessera (.*)\n)");
  std::smatch match;
  REQUIRE(std::regex_search(said, match, wrote));
  return match;
}

}  // namespace

TEST_CASE("A user's kernel that is wrong everywhere has its stage named and its triangles kept") {
  Desk desk;
  // Pieces that begin in some columns of the raster come out too near.
  desk.write(
      "mine.slang",
      changed(
          desk, "stages/setup.slang", "    storePiece(p, bounds, slot);",
          "    Piece q = p;\n    if ((q.x0 & 4095) < 512)\n        q.z0 = 0.0f;\n    storePiece(q, bounds, slot);"));
  const auto outcome = desk.tessera(
      "parity 'generate:icosphere?level=2' --size 64x64 --device cpu --kernel setup=mine.slang --replay found.replay");
  INFO(outcome.out << outcome.err);
  CHECK(outcome.code == 5);
  CHECK(has(outcome.out, "without --kernel it is as the oracle; first stage that differs: setup, piece "));
  const std::string said = outcome.err;
  const std::smatch replay = replayIn(said);
  CHECK(replay[1] == "found.replay");
  CHECK(std::stoi(replay[2]) <= 2);
  CHECK(replay[3] == "320");
  CHECK(replay[4].matched);
  CHECK(desk.names() == std::vector<std::string>{"found.replay", "mine.slang"});
  CHECK(desk.tessera(replay[5].str() + " --replay again.replay").code == 5);
  // With the kernels as they are it is equal: the replay holds the scene and not what went wrong.
  CHECK(desk.tessera("parity found.replay --device cpu").code == 0);
}

TEST_CASE("A setting that is wrong everywhere is named and the replay does not go into the working folder") {
  Desk desk;
  fs::copy(TESSERA_SOURCE_DIR "/slang", desk.path() / "slang", fs::copy_options::recursive);
  desk.write("slang/axes/traversal/scanline.slang",
             changed(desk, "axes/traversal/scanline.slang", "walkRow(p, s, row, column, last,",
                     "walkRow(p, s, row, column, last - 1,"));
  const auto outcome = desk.tessera(
      "parity 'generate:icosphere?level=2' --size 64x64 --device cpu --set tile=32 --set traversal=scanline",
      "TESSERA_SLANG_SOURCES=slang");
  INFO(outcome.out << outcome.err);
  CHECK(outcome.code == 5);
  CHECK(has(outcome.out,
            "cpu cpp without --set traversal=scanline it is as the oracle; first stage that differs: raster, pixel "));
  CHECK(desk.names() == std::vector<std::string>{"slang"});
  const std::string said = outcome.err;
  const std::smatch replay = replayIn(said);
  CHECK(replay[2] == "1");
  CHECK(desk.tessera(replay[5].str() + " --replay again.replay", "TESSERA_SLANG_SOURCES=slang").code == 5);
  CHECK(fs::remove(replay[1].str()));
}
