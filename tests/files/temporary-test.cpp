// Temporary names are new, one's own, and cleared when their run is gone.
#include "host/support/temporary.h"

#include <sys/stat.h>
#include <sys/wait.h>
#include <tessera/error.h>
#include <unistd.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <fstream>
#include <mutex>
#include <thread>
#include <vector>

#include "fixture.h"
#include "tests/support/error-line.h"

namespace tessera::test {
namespace fs = std::filesystem;

TEST_CASE("A temporary folder is new and its owner's alone and goes away") {
  const Folder folder;
  fs::path path;
  {
    const support::TemporaryFolder one(folder / "deep", "stem"), two(folder / "deep", "stem");
    path = one.path();
    CHECK(path != two.path());
    CHECK(fs::status(path).permissions() == fs::perms(0700));
    CHECK(path.filename().string().starts_with("stem."));
  }
  CHECK_FALSE(fs::exists(path));
  folder.write("file", "");
  CHECK(contains(lineOf(ExitCode::kUsage, [&] { support::TemporaryFolder(folder / "file", "stem"); }), "/file: "));
}

TEST_CASE("What a killed run left is cleared and what is in use stays") {
  const Folder folder;
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    new support::TemporaryFolder(folder / "", "work");  // never deleted, as in a run that is killed
    support::OutputFile* const file = new support::OutputFile(folder / "a.png");
    file->path();
    _exit(0);
  }
  REQUIRE(waitpid(child, nullptr, 0) == child);
  CHECK(folder.names().size() == 2);
  fs::create_directories(folder / "a.png.part");
  folder.write("a.png.backup.tmp", "");
  folder.write("keep.png.12-ab.tmp", "");  // of another name
  const support::TemporaryFolder work(folder / "", "work");
  support::OutputFile mine(folder / "a.png");
  mine.path();
  support::writeWhole(folder / "a.png", "text");  // beside the one that is in use
  CHECK(folder.names().size() == 6);
  CHECK(fs::exists(work.path()));
  CHECK(fs::exists(mine.path()));
  CHECK(fs::exists(folder / "a.png.backup.tmp"));
  CHECK(fs::exists(folder / "a.png.part"));
}

TEST_CASE("Runs that begin at once clear nothing of one another's") {
  const Folder folder;
  constexpr int kRuns = 4, kFolders = 400;
  std::atomic<int> whole = 0;
  std::mutex mutex;
  std::vector<std::string> errors;
  {
    std::vector<std::jthread> runs;
    for (int run = 0; run < kRuns; ++run)
      runs.emplace_back([&] {
        for (int i = 0; i < kFolders; ++i) try {
            const support::TemporaryFolder work(folder / "", "work");  // clears what it finds without an owner
            std::ofstream(work.path() / "file") << "text";
            whole += fs::exists(work.path() / "file");
          } catch (const Error& error) {
            const std::lock_guard lock(mutex);
            errors.emplace_back(error.what());
          }
      });
  }
  CHECK(errors == std::vector<std::string>{});
  CHECK(whole == kRuns * kFolders);
  CHECK(folder.names().empty());
}

TEST_CASE("A link planted under a temporary name is not followed") {
  const Folder folder;
  folder.write("victim", "precious");
  fs::create_symlink("victim", folder / "a.1-aaaaaaaa.tmp");
  support::clearTemporaries(folder / "", "a");
  CHECK(fs::is_symlink(folder / "a.1-aaaaaaaa.tmp"));
  CHECK(folder.read("victim") == "precious");
}

}  // namespace tessera::test
