#include "command.h"

#include <sys/wait.h>

#include <array>
#include <catch2/catch.hpp>
#include <cstdio>

namespace tessera::test {

Output run(const std::string& folder, const std::string& command) {
  Output output;
  FILE* const pipe = popen(("cd '" + folder + "' && { " + command + "; } 2>&1").c_str(), "r");
  REQUIRE(pipe);
  std::array<char, 4096> chunk;
  while (const std::size_t got = std::fread(chunk.data(), 1, chunk.size(), pipe)) output.text.append(chunk.data(), got);
  const int status = pclose(pipe);
  if (WIFEXITED(status)) output.code = WEXITSTATUS(status);
  return output;
}

}  // namespace tessera::test
