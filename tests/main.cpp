// main() of every test program.
#define CATCH_CONFIG_RUNNER
#include <catch2/catch.hpp>
#include <cstdlib>

#ifdef __SANITIZE_ADDRESS__
#include <dlfcn.h>
#endif

int main(int argc, char** argv) {
  // All tests of one build share its compiled kernels, and leave the user's own alone; programs that a test starts inherit this.
  setenv("TESSERA_CACHE", TESSERA_BINARY_DIR "/kernel-cache", 0);
#ifdef __SANITIZE_ADDRESS__
  // Mesa 22.3.6 allocates 128 bytes an instance to which only static memory of lavapipe points. That is no leak while it is loaded; it is one
  // once the loader unloads it, in a library that the sanitizer has no name for. So it stays. Programs that a test starts go unchecked.
  dlopen("libvulkan_lvp.so", RTLD_LAZY | RTLD_NODELETE);
  setenv("ASAN_OPTIONS", "detect_leaks=0", 0);
#endif
  return Catch::Session().run(argc, argv);
}
