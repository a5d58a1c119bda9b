// Folders that a sweep refuses stay as they are, byte for byte; one that is full is not the end of it.
#include <catch2/catch.hpp>
#include <map>

#include "running.h"

using namespace tessera::test;
namespace fs = std::filesystem;

namespace {

std::map<std::string, std::string> bytesOf(const Desk& desk) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(desk.path()))
    if (entry.is_regular_file()) {
      const std::string name = fs::relative(entry.path(), desk.path()).string();
      files[name] = desk.read(name);
    }
  return files;
}

/// tileSweep() of a mesh in place of its sphere.
std::string sweepOf(const std::string& mesh, unsigned rounds) {
  std::string sweep = tileSweep(rounds, 1);
  const std::string sphere = "generate:icosphere?level=2";
  return sweep.replace(sweep.find(sphere), sphere.size(), mesh);
}

void checkKept(const Desk& desk, const std::string& arguments, const std::string& reason) {
  const auto before = bytesOf(desk);
  const auto outcome = desk.tessera("sweep " + arguments);
  INFO(arguments << ": " << outcome.err);
  CHECK(outcome.code == 2);
  CHECK(outcome.complainsOnce());
  CHECK(outcome.err.find(reason) != std::string::npos);
  CHECK(bytesOf(desk) == before);
}

}  // namespace

TEST_CASE("Folders and inputs that will not do are refused in a line") {
  Desk desk;
  desk.write("tile.toml", tileSweep(1, 1));
  desk.write("other.toml", tileSweep(2, 1));
  fs::create_directory(desk.path() / "thesis");
  desk.write("thesis/chapter.txt", "years of work\n");
  for (const std::string resume : {"", " --resume"}) {
    checkKept(desk, "tile.toml --out thesis" + resume, "holds chapter.txt and no sweep");
    checkKept(desk, "tile.toml --out other.toml" + resume, "is a file");
  }
  REQUIRE(desk.tessera("sweep tile.toml --out out").code == 0);
  checkKept(desk, "tile.toml --out out", "--resume goes on with it");
  checkKept(desk, "other.toml --out out --resume", "of another file");
  checkKept(desk, "tile.toml --out new --job cube@cpu", "ball@cpu");
  checkKept(desk, "tile.toml --out new --quick", "quick");

  const std::string journal = desk.read("out/journal.jsonl");
  const std::string version = "\"schema_version\":3";
  const std::size_t at = journal.find(version);
  REQUIRE(at != std::string::npos);
  desk.write("out/journal.jsonl", std::string(journal).replace(at, version.size(), "\"schema_version\":1"));
  checkKept(desk, "tile.toml --out out --resume", "rows of version 1");
  desk.write("out/journal.jsonl", "{\"kind\":\"shopping\"}\n");
  checkKept(desk, "tile.toml --out out --resume", "journal.jsonl:1: no line of a sweep's journal");
  desk.write("out/journal.jsonl", journal + "{}\n");
  checkKept(desk, "tile.toml --out out --resume", "no line of a sweep's journal");

  desk.write("gone.toml", tileSweep(1, 1, "devices = [\"vulkan:of another house\"]"));
  checkKept(desk, "gone.toml --out new", "no such device");
  desk.write("bad.obj", "v 1 2\n");
  desk.write("bad.toml", sweepOf("bad.obj", 1));
  checkKept(desk, "bad.toml --out new", "bad.obj:1");
  CHECK_FALSE(fs::exists(desk.path() / "new"));
}

TEST_CASE("A scene that has changed does not resume") {
  Desk desk;
  desk.write("two.obj", twoTriangles());
  desk.write("tile.toml", sweepOf("two.obj", 2));
  REQUIRE(desk.tessera("sweep tile.toml --out out").code == 0);
  const std::string journal = desk.read("out/journal.jsonl");
  desk.write("out/journal.jsonl", journal.substr(0, journal.rfind('\n', journal.size() - 2) + 1));
  fs::remove(desk.path() / "out/rows.jsonl");  // which comes with the end
  desk.write("two.obj", twoTriangles() + "v 9 9 9\n");
  checkKept(desk, "tile.toml --out out --resume", "its scene is not what it was");
}

TEST_CASE("A sweep that has ended is not of a scene that has changed since") {
  Desk desk;
  desk.write("two.obj", twoTriangles());
  desk.write("tile.toml", sweepOf("two.obj", 1));
  REQUIRE(desk.tessera("sweep tile.toml --out out").code == 0);
  desk.write("two.obj", twoTriangles() + "v 9 9 9\n");
  checkKept(desk, "tile.toml --out out --resume", "its scene is not what it was");
}

TEST_CASE("One sweep at a time writes to a folder") {
  Desk desk;
  desk.write("tile.toml", tileSweep(100, 2));
  Running first(desk, "sweep tile.toml --out out");
  REQUIRE(first.until([&] { return desk.read("out/journal.jsonl").find("\"sample\"") != std::string::npos; }));
  const auto second = desk.tessera("sweep tile.toml --out out --resume");
  CHECK(second.code == 2);
  CHECK(second.complainsOnce());
  CHECK(second.err.find("another sweep is writing") != std::string::npos);
  CHECK(first.wait() == 0);
}

TEST_CASE("A full disk is one line and the sweep goes on once there is room") {
  Desk desk;
  desk.write("tile.toml", tileSweep(20, 2));
  REQUIRE(desk.tessera("sweep tile.toml --out whole").code == 0);
  // A limit on the size of a file stands for the disk: writes come short, then fail. Blocks of 512 bytes.
  const auto full = desk.tessera("sweep tile.toml --out out", "trap '' XFSZ; ulimit -f 60;");
  INFO(full.err);
  CHECK(full.code == 1);
  CHECK(full.complainsOnce());
  CHECK(full.err.find("journal.jsonl: could not be written") != std::string::npos);
  const std::string journal = desk.read("out/journal.jsonl");
  CHECK(journal.size() <= 60 * 512);
  CHECK(journal.back() == '\n');
  CHECK(journal.find("\"sample\"") != std::string::npos);

  const auto resumed = desk.tessera("sweep tile.toml --out out --resume");
  INFO(resumed.err);
  REQUIRE(resumed.code == 0);
  CHECK(desk.read("out/journal.jsonl").starts_with(journal));
  CHECK(timelessRows(desk, "out") == timelessRows(desk, "whole"));
}

TEST_CASE("A picture that cannot be written is no fault of its cell") {
  Desk desk;
  desk.write("tile.toml", tileSweep(1, 1) + "[truth]\nsub-pixel = 0\n");
  REQUIRE(desk.tessera("sweep tile.toml --out out").code == 0);
  REQUIRE(sizeOf(desk, "out/pictures/3.png") > 0);
  const std::string journal = desk.read("out/journal.jsonl");
  const std::string head = journal.substr(0, journal.find('\n') + 1);
  fs::remove(desk.path() / "out/rows.jsonl");
  fs::remove_all(desk.path() / "out/pictures");
  desk.write("out/pictures", "in the way\n");
  desk.write("out/journal.jsonl", head);
  const auto outcome = desk.tessera("sweep tile.toml --out out --resume");
  CHECK(outcome.code == 1);
  CHECK(outcome.complainsOnce());
  CHECK(outcome.err.find("pictures/0.png: could not be written: Not a directory; --resume") != std::string::npos);
  INFO(outcome.err);
  CHECK_FALSE(fs::exists(desk.path() / "out/rows.jsonl"));
  CHECK(journalLines(desk, "out", "cell").empty());
}
