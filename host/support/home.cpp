#include "host/support/home.h"

#include <unistd.h>

#include <vector>

namespace tessera::support {
namespace {

namespace fs = std::filesystem;

// Below the prefix; cmake/install.cmake puts the files there.
constexpr const char* kSlang = TESSERA_INSTALLED_DATA "/slang";
constexpr const char* kSlangc = TESSERA_INSTALLED_TOOLS "/slang/bin/slangc";
constexpr const char* kReport = TESSERA_INSTALLED_DATA "/report";
constexpr const char* kPython = TESSERA_INSTALLED_TOOLS "/python/bin/python";
constexpr const char* kPins = TESSERA_INSTALLED_DATA "/report.txt";

/// The prefix where `file` is at its place below one, else "".
fs::path prefixOf(fs::path file, const fs::path& place) {
  for (auto part = place.end(); part != place.begin();) {
    if (*--part != file.filename()) return {};
    file = file.parent_path();
  }
  return file;
}

Home findHome() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);  // links to it are followed
  const fs::path prefix = (program.parent_path() / TESSERA_BIN_TO_PREFIX).lexically_normal();
  if (!error && fs::is_directory(prefix / kSlang, error))
    return {true, prefix / kSlang, prefix / kSlangc, prefix / kReport, prefix / kPython, prefix / kPins};
  const fs::path clone = TESSERA_CLONE;
  return {false,
          clone / "slang",
          clone / ".tools/slang/bin/slangc",
          clone / "experiments/report",
          clone / ".tools/report/bin/python",
          clone / "tools/report.txt"};
}

}  // namespace

const Home& home() {
  static const Home found = findHome();
  return found;
}

fs::path slangcOf(const fs::path& slangSources) {
  const fs::path sources = fs::absolute(slangSources / "").lexically_normal().parent_path();  // without a slash behind
  std::vector<fs::path> places{sources.parent_path() / ".tools/slang/bin/slangc"};
  if (const fs::path prefix = prefixOf(sources, kSlang); !prefix.empty()) places.push_back(prefix / kSlangc);
  for (const fs::path& place : places)
    if (access(place.c_str(), X_OK) == 0) return place;
  return home().slangc;
}

}  // namespace tessera::support
