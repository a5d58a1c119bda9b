// Loaded before a program: as the stream of number FULL_AT is opened on a temporary file (NAME.tmp), the limit on open
// files is reached, and stays so. The program meets the limit there whatever else it holds open, and on which thread.
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>

#include <atomic>
#include <string_view>

namespace {

void beforeStream(const char* name) {
  static std::atomic<int> opened = 0;
  const char* const at = getenv("FULL_AT");
  if (!at || !std::string_view(name).ends_with(".tmp") || ++opened != atoi(at)) return;
  rlimit files{};
  getrlimit(RLIMIT_NOFILE, &files);
  files.rlim_cur = 0;
  setrlimit(RLIMIT_NOFILE, &files);
}

}  // namespace

extern "C" FILE* fopen(const char* name, const char* mode) {
  beforeStream(name);
  return reinterpret_cast<decltype(&fopen)>(dlsym(RTLD_NEXT, "fopen"))(name, mode);
}

extern "C" FILE* fopen64(const char* name, const char* mode) {
  beforeStream(name);
  return reinterpret_cast<decltype(&fopen)>(dlsym(RTLD_NEXT, "fopen64"))(name, mode);
}
