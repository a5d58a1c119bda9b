// Lines are added whole.
#include <catch2/catch.hpp>
#include <string>
#include <thread>

#include "fixture.h"
#include "tests/support/error-line.h"

namespace tessera::test {
namespace fs = std::filesystem;

TEST_CASE("Lines are added at the end and a new file is made") {
  const Folder folder;
  support::AppendedFile file(folder / "a");
  CHECK(folder.names().empty());
  file.append("one");
  file.append("two\nthree\n");
  CHECK(folder.read("a") == "one\ntwo\nthree\n");
  folder.write("half", "{\"cut");
  support::AppendedFile(folder / "half").append("whole");
  CHECK(folder.read("half") == "{\"cut\nwhole\n");
  fs::create_symlink("a", folder / "link");
  fs::create_hard_link(folder / "a", folder / "hard");
  support::AppendedFile(folder / "link").append("four");
  CHECK(folder.read("hard") == "one\ntwo\nthree\nfour\n");
  CHECK(fs::is_symlink(folder / "link"));
}

TEST_CASE("A line that does not fit leaves the lines before it") {
  const Folder folder;
  support::AppendedFile(folder / "a").append("good");
  const std::string large(5000, 'x');
  {
    const FileLimit limit(1000);
    const std::string line = lineOf(ExitCode::kFailure, [&] { support::AppendedFile(folder / "a").append(large); });
    CHECK(contains(line, "/a: could not be written: File too large"));  // after a part of it had room
    lineOf(ExitCode::kFailure, [&] { support::AppendedFile(folder / "new").append(large); });
  }
  CHECK(folder.read("a") == "good\n");
  CHECK(folder.names() == std::vector<std::string>{"a"});
}

TEST_CASE("Lines of many writers do not mix") {
  const Folder folder;
  std::vector<std::thread> writers;
  for (const char letter : {'a', 'b', 'c', 'd'})
    writers.emplace_back([&folder, letter] {
      for (int i = 0; i < 20; ++i) support::AppendedFile(folder / "rows").append(std::string(3000, letter));
    });
  for (std::thread& writer : writers) writer.join();
  const std::string text = folder.read("rows");
  CHECK(text.size() == 4 * 20 * 3001);
  for (std::size_t begin = 0; begin < text.size(); begin += 3001)
    CHECK(text.substr(begin, 3001) == std::string(3000, text[begin]) + '\n');
}

}  // namespace tessera::test
