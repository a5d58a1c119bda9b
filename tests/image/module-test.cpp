// OpenImageIO and its 260 libraries are loaded for images alone: the command itself is linked with none of them.
#include <catch2/catch.hpp>
#include <cstdio>
#include <filesystem>

#include "command.h"
#include "host/support/files.h"

using Catch::Matchers::Contains;
using tessera::test::Output;
using tessera::test::run;
namespace fs = std::filesystem;

TEST_CASE("the command is linked with no image library") {
  const Output linked = run(".", "ldd '" TESSERA_PROGRAM "'");
  INFO(linked.text);
  REQUIRE(linked.code == 0);
  CHECK_THAT(linked.text, Contains("libstdc++"));  // it does list what is linked
  CHECK_THAT(linked.text, !Contains("OpenImageIO") && !Contains("OpenEXR") && !Contains("libpng"));
  const Output module = run(".", "ldd '" TESSERA_BINARY_DIR "/libtessera-image-io.so'");
  CHECK_THAT(module.text, Contains("OpenImageIO"));
}

TEST_CASE("a command without the image module says what is missing") {
  const tessera::support::TemporaryFolder folder(tessera::support::temporaryRoot(), "tessera-image-module-test");
  // Where the loader looks first there is a file of this name that is no library.
  const fs::path stand = folder.path() / "libtessera-image-io.so";
  std::fclose(std::fopen(stand.c_str(), "w"));
  const Output written = run(folder.path().string(), "LD_LIBRARY_PATH=\"$PWD\" '" TESSERA_PROGRAM
                                                     "' render 'generate:icosphere?level=1' --size 16x16 -o a.png");
  INFO(written.text);
  CHECK(written.code == 1);
  CHECK_THAT(written.text, Contains("images can be neither read nor written") && Contains("libtessera-image-io.so"));
  CHECK_FALSE(fs::exists(folder.path() / "a.png"));
}
