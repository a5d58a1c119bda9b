#include "host/images/image-module.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <tessera/error.h>
#include <tessera/image.h>

#include <chrono>
#include <future>
#include <latch>
#include <mutex>
#include <optional>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

namespace tessera {
namespace {

constexpr char kFile[] = "libtessera-image-io.so";

struct Loaded {
  const images::Module* module = nullptr;
  std::string why;  // there is none
  double milliseconds = 0;
};

// OpenImageIO and libraries that it stands on make threads while they are loaded, and a thread that they cannot make
// ends the process. So as many threads as they make at most are made here first. Text: why they cannot be.
std::string lackOfThreads() {
  constexpr unsigned kFixed = 8;                                             // log4cplus' pool of 4, and some room
  const unsigned wanted = kFixed + 2 * std::thread::hardware_concurrency();  // those of OpenBLAS, OpenImageIO, OpenEXR
  std::latch all(1);
  std::vector<std::jthread> threads;
  std::string why;
  try {
    while (threads.size() < wanted) threads.emplace_back([&all] { all.wait(); });
  } catch (const std::system_error& error) {
    why = fmt::format("OpenImageIO and its libraries make up to {} threads, and thread {} cannot be made: {}", wanted,
                      threads.size() + 1, error.code().message());
  }
  all.count_down();
  return why;
}

// The loader looks in the folders that were linked into the program (cmake/install.cmake), and in LD_LIBRARY_PATH.
Loaded load() {
  const auto start = std::chrono::steady_clock::now();
  Loaded result;
  if (result.why = lackOfThreads(); !result.why.empty()) return result;
  void* const library = dlopen(kFile, RTLD_LAZY | RTLD_LOCAL);
  void* const entry = library ? dlsym(library, images::kEntry) : nullptr;
  if (entry) {
    result.module = reinterpret_cast<const images::Module* (*)()>(entry)();
    if (std::string_view(result.module->version) != TESSERA_MODULE_VERSION) {
      result.why =
          fmt::format("{} is of version {}; {} would be right", kFile, result.module->version, TESSERA_MODULE_VERSION);
      result.module = nullptr;
    }
  } else {
    const char* const why = dlerror();
    result.why =
        fmt::format("{}; {} should lie where Tessera was built or installed, and Debian's libopenimageio2.4 be there",
                    why ? why : kFile, kFile);
  }
  result.milliseconds = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  return result;
}

std::mutex gate;
std::optional<std::future<Loaded>> loading;

const Loaded& loaded() {
  static const Loaded result = [] {
    std::optional<std::future<Loaded>> begun;
    {
      const std::lock_guard lock(gate);
      begun.swap(loading);
    }
    return begun ? begun->get() : load();
  }();
  return result;
}

}  // namespace

namespace images {

const images::Module& imageModule() {
  const Loaded& result = loaded();
  if (!result.module) fail(fmt::format("images can be neither read nor written: {}", result.why));
  return *result.module;
}

}  // namespace images

void startLoadingImages() {
  const std::lock_guard lock(gate);
  if (loading) return;
  try {
    loading = std::async(std::launch::async, load);
  } catch (const std::system_error&) {
    // No thread can be had: the first image loads it.
  }
}

double finishLoadingImages() {
  images::imageModule();
  return loaded().milliseconds;
}

}  // namespace tessera
