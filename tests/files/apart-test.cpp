// No two outputs are one file, and none is an input.
#include <sys/stat.h>

#include <catch2/catch.hpp>

#include "fixture.h"
#include "tests/support/error-line.h"

namespace tessera::test {
namespace fs = std::filesystem;

TEST_CASE("Two outputs of one file are refused under whatever names") {
  const Folder folder;
  fs::create_directory(folder / "deep");
  folder.write("a", "text");
  fs::create_hard_link(folder / "a", folder / "hard");
  fs::create_symlink("a", folder / "link");
  fs::create_symlink("new", folder / "dangling");
  fs::create_directory_symlink("deep", folder / "way");
  REQUIRE(mkfifo((folder / "pipe").c_str(), 0600) == 0);
  const auto twice = [&](const fs::path& one, const fs::path& other) {
    INFO(one << " " << other);
    CHECK(contains(lineOf(ExitCode::kUsage,
                          [&] {
                            support::checkApart({one, folder / "else", other}, {});
                          }),
                   other.string()));
  };
  twice(folder / "a", folder / "a");
  twice(folder / "a", folder / "deep/../a");
  twice(folder / "a", folder / "hard");
  twice(folder / "a", folder / "link");
  twice(folder / "new", folder / "dangling");
  twice(folder / "deep/new", folder / "way/new");
  twice(folder / "pipe", folder / "pipe");
  twice("-", "-");
  twice("-", "/dev/stdout");
  support::checkApart({folder / "a", folder / "new", "-", "/dev/null", "/dev/null"},
                      {folder / "pipe", folder / "missing"});
}

TEST_CASE("An output that is an input is refused under whatever name") {
  const Folder folder;
  folder.write("mesh", "text");
  fs::create_hard_link(folder / "mesh", folder / "hard");
  fs::create_symlink("mesh", folder / "link");
  for (const char* const name : {"mesh", "hard", "link"})
    CHECK(contains(lineOf(ExitCode::kUsage, [&] { support::checkApart({folder / name}, {folder / "mesh"}); }),
                   "another name would keep it"));
  CHECK(contains(lineOf(ExitCode::kUsage, [&] { support::checkApart({folder / "mesh"}, {folder / "link"}); }), "link"));
}

}  // namespace tessera::test
