// Running another program and keeping what it says. No shell: arguments reach the program as they are.
#pragma once

#include <tessera/error.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace tessera::support {

struct ProcessResult {
  int status = 0;      ///< exit status; 128 + the signal's number if one ended it
  std::string output;  ///< stdout and stderr together, in the C locale
  bool ok() const { return status == 0; }
};

/// The system has no room for another process, pipe or file now; the program that was to run is not at fault.
class ShortageError : public Error {
 public:
  using Error::Error;
};

/// Runs `arguments[0]` (a path) and waits for it; its temporary files go into `temporary`, if that is said. Throws
/// kFailure only if it cannot be started.
ProcessResult runProcess(const std::vector<std::string>& arguments, const std::filesystem::path& temporary = {});

/// Full path of a program: `name` itself where it holds a slash, else the first executable of that name in PATH. Empty
/// if there is none.
std::filesystem::path findProgram(std::string_view name);

}  // namespace tessera::support
