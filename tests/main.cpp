// main() of every test program.
#define CATCH_CONFIG_RUNNER
#include <catch2/catch.hpp>
#include <cstdlib>

int main(int argc, char** argv) {
  // All tests of one build share its compiled kernels, and leave the user's own alone; programs that a test starts inherit this.
  setenv("TESSERA_CACHE", TESSERA_BINARY_DIR "/kernel-cache", 0);
  return Catch::Session().run(argc, argv);
}
