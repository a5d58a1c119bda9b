// Files made for one test, and the one line that bad input must give.
#pragma once

#include <tessera/error.h>
#include <tessera/input.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>
#include <string_view>

#include "host/support/files.h"

namespace tessera::test {

class Files {
 public:
  /// Writes a file and returns its path.
  std::string write(const std::string& name, std::string_view text) const;
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

 private:
  support::TemporaryFolder folder_{std::filesystem::temp_directory_path(), "datasets-test"};
};

/// The message of the kUsage error that `action` throws; the test fails if it throws none, another one, or more than a
/// line.
template <class Action>
std::string usageError(Action action) {
  try {
    action();
  } catch (const Error& error) {
    CHECK(error.code() == ExitCode::kUsage);
    const std::string line = error.what();
    CHECK(line.find('\n') == std::string::npos);
    return line;
  }
  FAIL("no error was thrown");
  return "";
}

/// usageError() of reading a mesh, without the file's folder.
std::string readError(const Files& files, const std::string& name, std::string_view text);

}  // namespace tessera::test
