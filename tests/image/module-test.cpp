// OpenImageIO and its 260 libraries are loaded for images alone: the command itself is linked with none of them.
#include <sys/wait.h>

#include <array>
#include <catch2/catch.hpp>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "host/files.h"

using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

struct Output {
  int code = -1;
  std::string text;
};

Output run(const std::string& command) {
  Output output;
  FILE* const pipe = popen((command + " 2>&1").c_str(), "r");
  REQUIRE(pipe);
  std::array<char, 4096> chunk;
  while (const std::size_t got = std::fread(chunk.data(), 1, chunk.size(), pipe)) output.text.append(chunk.data(), got);
  const int status = pclose(pipe);
  if (WIFEXITED(status)) output.code = WEXITSTATUS(status);
  return output;
}

}  // namespace

TEST_CASE("the command is linked with no image library") {
  const Output linked = run("ldd '" TESSERA_PROGRAM "'");
  INFO(linked.text);
  REQUIRE(linked.code == 0);
  CHECK_THAT(linked.text, Contains("libstdc++"));  // it does list what is linked
  CHECK_THAT(linked.text, !Contains("OpenImageIO") && !Contains("OpenEXR") && !Contains("libpng"));
  const Output module = run("ldd '" TESSERA_BINARY_DIR "/libtessera-image-io.so'");
  CHECK_THAT(module.text, Contains("OpenImageIO"));
}

TEST_CASE("a command without the image module says what is missing") {
  const tessera::TemporaryFolder folder(tessera::temporaryRoot(), "tessera-image-module-test");
  // Where the loader looks first there is a file of this name that is no library.
  const fs::path stand = folder.path() / "libtessera-image-io.so";
  std::fclose(std::fopen(stand.c_str(), "w"));
  const Output written =
      run("cd '" + folder.path().string() + "' && LD_PRELOAD= LD_LIBRARY_PATH='" + folder.path().string() +
          "' '" TESSERA_PROGRAM "' render 'generate:icosphere?level=1' --size 16x16 -o a.png");
  INFO(written.text);
  CHECK(written.code == 1);
  CHECK_THAT(written.text, Contains("images can be neither read nor written") && Contains("libtessera-image-io.so"));
  CHECK_FALSE(fs::exists(folder.path() / "a.png"));
}
