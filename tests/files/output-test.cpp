// Outputs are whole or not there, and go to what their name leads to.
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <sys/un.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <cstdlib>
#include <fstream>

#include "fixture.h"
#include "tests/support/error-line.h"

namespace tessera::test {
namespace fs = std::filesystem;
using Names = std::vector<std::string>;

TEST_CASE("A file appears whole and only when it is committed") {
  const Folder folder;
  folder.write("a", "old");
  {
    support::OutputFile file(folder / "a");
    CHECK(folder.names() == Names{"a"});  // nothing lies there while the work goes on
    std::ofstream(file.path()) << "new";
    CHECK(folder.read("a") == "old");
  }
  CHECK(folder.names() == Names{"a"});
  support::OutputFile file(folder / "a");
  std::ofstream(file.path()) << "new";
  file.commit();
  CHECK(folder.read("a") == "new");
  CHECK(folder.names() == Names{"a"});
  support::writeWhole(folder / "b", "");
  CHECK(folder.names() == Names{"a", "b"});
}

TEST_CASE("A file that did not arrive as it should leaves the old one") {
  const Folder folder;
  folder.write("a", "old");
  const auto check = [&](std::optional<std::uintmax_t> bytes, const std::string& text, const std::string& why) {
    support::OutputFile file(folder / "a");
    std::ofstream(file.path()) << text;
    CHECK(contains(lineOf(ExitCode::kFailure, [&] { file.commit(bytes); }), why));
  };
  check({}, "", "no byte arrived");
  check(5, "new", "3 of 5 bytes arrived");
  {
    const FileLimit limit(1000);
    const std::string line =
        lineOf(ExitCode::kFailure, [&] { support::writeWhole(folder / "a", std::string(5000, 'x')); });
    CHECK(contains(line, "/a: could not be written: File too large"));
  }
  CHECK(folder.read("a") == "old");
  CHECK(folder.names() == Names{"a"});
}

TEST_CASE("A symbolic link stays and its target is written") {
  const Folder folder;
  fs::create_directory(folder / "far");
  folder.write("far/target", "old");
  fs::create_symlink("far/target", folder / "link");
  fs::create_symlink("link", folder / "second");
  fs::create_symlink("far/new", folder / "dangling");
  fs::create_symlink("nowhere/new", folder / "lost");
  fs::create_symlink("loop", folder / "loop");
  support::writeWhole(folder / "second", "new");
  CHECK(fs::is_symlink(folder / "link"));
  CHECK(fs::is_symlink(folder / "second"));
  CHECK(folder.read("far/target") == "new");
  support::writeWhole(folder / "dangling", "made");
  CHECK(fs::is_symlink(folder / "dangling"));
  CHECK(folder.read("far/new") == "made");
  CHECK(contains(lineOf(ExitCode::kUsage, [&] { support::OutputFile{folder / "lost"}; }), "nowhere does not exist"));
  CHECK(contains(lineOf(ExitCode::kUsage, [&] { support::OutputFile{folder / "loop"}; }), "loop"));
}

TEST_CASE("A file keeps its mode and a hard link keeps the old text") {
  const Folder folder;
  folder.write("a", "old");
  fs::create_hard_link(folder / "a", folder / "b");
  fs::permissions(folder / "a", fs::perms(0640));
  support::writeWhole(folder / "a", "new");
  CHECK(fs::status(folder / "a").permissions() == fs::perms(0640));
  CHECK(folder.read("b") == "old");
  const mode_t before = umask(027);
  support::writeWhole(folder / "c", "new");
  umask(before);
  CHECK(fs::status(folder / "c").permissions() == fs::perms(0640));
}

TEST_CASE("A device is written to and stays a device") {
  const Folder folder;
  fs::path null = "/dev/null", full = "/dev/full";
  if (mknod((folder / "null").c_str(), S_IFCHR | 0666, makedev(1, 3)) == 0) null = folder / "null";  // as root
  support::writeWhole(null, "text");
  support::OutputFile file(null);
  std::ofstream(file.path()) << "picture";
  file.commit();
  support::AppendedFile(null).append("row");
  CHECK(fs::is_character_file(null));
  const auto check = [&](const std::function<void()>& write) {
    CHECK(contains(lineOf(ExitCode::kFailure, write), "/dev/full: could not be written: No space left on device"));
  };
  check([&] { support::writeWhole(full, "text"); });
  check([&] { support::AppendedFile(full).append("row"); });
  check([&] {
    support::OutputFile picture(full);
    std::ofstream(picture.path()) << "picture";
    picture.commit();
  });
}

TEST_CASE("A pipe gets the bytes and stays a pipe") {
  const Folder folder;
  const fs::path pipe = folder / "pipe";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  const std::string large(300'000, 'x');  // more than a pipe holds
  auto text = readPipe(pipe);
  support::writeWhole(pipe, large);
  CHECK(text.get() == large);
  text = readPipe(pipe);
  support::AppendedFile(pipe).append("row");
  CHECK(text.get() == "row\n");
  text = readPipe(pipe);
  {
    support::OutputFile file(pipe);
    std::ofstream(file.path()) << large;
    file.commit();
  }
  CHECK(text.get() == large);
  CHECK(fs::is_fifo(pipe));
  CHECK(folder.names() == Names{"pipe"});
}

TEST_CASE("A pipe whose reader goes away is an error with its name") {
  std::signal(SIGPIPE, SIG_IGN);
  const Folder folder;
  REQUIRE(mkfifo((folder / "pipe").c_str(), 0600) == 0);
  const int reader = open((folder / "pipe").c_str(), O_RDONLY | O_NONBLOCK);
  support::OutputFile file(folder / "pipe");
  std::ofstream(file.path()) << "picture";
  close(reader);
  CHECK(contains(lineOf(ExitCode::kFailure, [&] { file.commit(); }), "pipe: could not be written: Broken pipe"));
}

TEST_CASE("Descriptors are written to where they stand") {
  const Folder folder;
  folder.write("a", "first ");
  const int file = open((folder / "a").c_str(), O_WRONLY | O_APPEND);
  for (const char* const form : {"/dev/fd/{}", "/proc/self/fd/{}"}) {
    const std::string name = fmt::format(fmt::runtime(form), file);
    support::writeWhole(name, "text ");
    support::AppendedFile(name).append("row");
    support::OutputFile picture(name);
    std::ofstream(picture.path()) << "picture ";
    picture.commit();
  }
  close(file);
  CHECK(folder.read("a") == "first text row\npicture text row\npicture ");
  const int reading = open((folder / "a").c_str(), O_RDONLY);
  CHECK(contains(lineOf(ExitCode::kUsage, [&] { support::OutputFile{fmt::format("/dev/fd/{}", reading)}; }),
                 "reading only"));
  close(reading);
  CHECK(contains(lineOf(ExitCode::kUsage, [&] { support::OutputFile{"/dev/fd/987"}; }), "not open"));
}

TEST_CASE("Where nothing can be written is said before the work") {
  const Folder folder;
  folder.write("file", "text");
  fs::create_directory(folder / "folder");
  const int socket = ::socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{.sun_family = AF_UNIX, .sun_path = {}};
  const std::string name = folder / "socket";
  REQUIRE(name.size() < sizeof address.sun_path);
  name.copy(address.sun_path, name.size());
  REQUIRE(bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
  const auto check = [&](const fs::path& path, const std::string& why) {
    CHECK(contains(lineOf(ExitCode::kUsage, [&] { support::OutputFile{path}; }), why));
    CHECK(contains(lineOf(ExitCode::kUsage, [&] { support::AppendedFile{path}; }), why));
    CHECK(contains(lineOf(ExitCode::kUsage, [&] { support::checkWhole(path); }), why));
  };
  check("", "has no name");
  check(folder / "folder", "is a folder");
  check(folder / "folder/", "is a folder");
  check(folder / "nowhere/a", "nowhere does not exist");
  check(folder / "nowhere/", "nowhere");
  check(folder / "file/a", "Not a directory");
  check(folder / "socket", "is a socket");
  check(folder / std::string(256, 'n'), "File name too long");
  check("/proc/a", "/proc");
  close(socket);
  if (geteuid() == 0) return;  // root may write all that follows
  fs::permissions(folder / "file", fs::perms(0444));
  check(folder / "file", "cannot be written: Permission denied");
  support::writeWhole(folder / "folder/a", "text");
  fs::permissions(folder / "folder", fs::perms(0555));
  check(folder / "folder/b", "cannot be written: Permission denied");
  CHECK(contains(lineOf(ExitCode::kUsage, [&] { support::OutputFile{folder / "folder/a"}; }), "beside its name first"));
  support::AppendedFile(folder / "folder/a").append("row");  // which needs no new file
  fs::permissions(folder / "folder", fs::perms(0755));
}

TEST_CASE("Names near the longest work") {
  const Folder folder;
  std::string accents = "x";
  while (accents.size() < 254) accents += "\u00e9";
  for (const std::string& name : {std::string(255, 'n'), accents}) {
    support::writeWhole(folder / name, "text");
    support::AppendedFile(folder / name).append("row");
    CHECK(folder.read(name) == "text\nrow\n");
  }
}

TEST_CASE("The temporary folder is named where it is missing") {
  const std::string before = std::getenv("TMPDIR") ? std::getenv("TMPDIR") : "";
  setenv("TMPDIR", "/nowhere/tmp", 1);
  const std::string line = lineOf(ExitCode::kUsage, [] { support::OutputFile{"/dev/null"}; });
  before.empty() ? unsetenv("TMPDIR") : setenv("TMPDIR", before.c_str(), 1);
  CHECK(contains(line, "/nowhere/tmp: cannot be written: No such file or directory"));
}

}  // namespace tessera::test
