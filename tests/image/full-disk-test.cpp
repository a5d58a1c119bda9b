// A disk that is full: the image is an error, wherever in the file the room ends, and the old file stays.
#include <sys/mount.h>
#include <sys/resource.h>
#include <tessera/error.h>
#include <tessera/image.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "command.h"
#include "host/support/files.h"

using namespace tessera;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

Framebuffer noise(std::uint32_t extent) {
  Framebuffer frame{.width = extent, .height = extent, .depth = {}, .ids = {}, .hits = {}, .colour = {}};
  std::uint32_t state = 1;
  for (std::size_t k = 0; k < frame.pixels(); ++k) frame.hits.push_back((state = state * 1664525u + 1013904223u) >> 8);
  return frame;
}

std::string bytesOf(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// While it is there no file grows beyond `bytes`: writes fail as those of a full disk do.
class NoRoom {
 public:
  explicit NoRoom(rlim_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    rlimit limit = before_;
    limit.rlim_cur = bytes;
    REQUIRE(setrlimit(RLIMIT_FSIZE, &limit) == 0);
  }
  ~NoRoom() { setrlimit(RLIMIT_FSIZE, &before_); }

 private:
  rlimit before_{};
};

}  // namespace

TEST_CASE("an image for which there is no room is an error and the old file stays") {
  const support::TemporaryFolder folder(support::temporaryRoot(), "tessera-full-disk-test");
  const Framebuffer frame = noise(100);
  for (const char* name : {"a.png", "a.exr"}) {
    const fs::path path = folder.path() / name;
    writeImage(path, frame);
    const std::string whole = bytesOf(path);
    std::ofstream(path, std::ios::binary) << "old";
    for (const std::size_t room :
         {std::size_t{0}, std::size_t{1}, std::size_t{1000}, whole.size() / 2, whole.size() - 1}) {
      CAPTURE(name, room);
      std::string line = "(nothing was thrown)";
      {
        const NoRoom full(room);
        try {
          writeImage(path, frame);
        } catch (const Error& error) {
          CHECK(error.code() == ExitCode::kFailure);
          line = error.what();
        }
      }
      CHECK_THAT(line, Contains(name) && Contains("could not be written") && !Contains("\n"));
      CHECK(bytesOf(path) == "old");
    }
    {
      const NoRoom justEnough(whole.size());
      writeImage(path, frame);
    }
    CHECK(bytesOf(path) == whole);
  }
  CHECK(std::distance(fs::directory_iterator(folder.path()), {}) == 2);  // nothing is left beside them
}

TEST_CASE("on a full file system render and compare leave the old images") {
  const support::TemporaryFolder folder(support::temporaryRoot(), "tessera-full-disk-test");
  const std::string disk = folder.path() / "disk";
  fs::create_directory(disk);
  if (geteuid() != 0 || mount("tessera", disk.c_str(), "tmpfs", 0, "size=16k") != 0) {
    WARN("no file system can be mounted here: the test of a limited file stands alone");
    return;
  }
  struct Unmount {
    const std::string& disk;
    ~Unmount() { umount2(disk.c_str(), MNT_DETACH); }
  } const unmount{disk};
  for (const char* name : {"a.png", "a.exr", "d.png"}) std::ofstream(fs::path(disk) / name) << "old";
  Framebuffer frame = noise(512);
  writeImage(folder.path() / "x.exr", frame);
  for (auto& hits : frame.hits) hits ^= hits >> 9 & 1;  // half of them, so that the picture is noise, too
  writeImage(folder.path() / "y.exr", frame);
  for (const std::string command :
       {"render 'generate:icosphere?level=3' --size 512x512 -o disk/a.png",
        "render 'generate:icosphere?level=3' --size 512x512 -o disk/a.exr", "compare x.exr y.exr -o exr:disk/d.png"}) {
    const auto outcome = test::run(folder.path(), "'" TESSERA_PROGRAM "' " + command);
    INFO(command << "\n" << outcome.text);
    CHECK(outcome.code == 1);
    CHECK_THAT(outcome.text, Contains("could not be written: No space left on device\n") && !Contains("wrote"));
  }
  for (const char* name : {"a.png", "a.exr", "d.png"}) CHECK(bytesOf(fs::path(disk) / name) == "old");
  CHECK(std::distance(fs::directory_iterator(disk), {}) == 3);
}
