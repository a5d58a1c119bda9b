// The program as a shell runs it.
#pragma once

#include <string>

namespace tessera::test {

struct Output {
  int code = -1;
  std::string text;  ///< of stdout and stderr
};
/// A command of the shell, with `cd folder` before it.
Output run(const std::string& folder, const std::string& command);

}  // namespace tessera::test
