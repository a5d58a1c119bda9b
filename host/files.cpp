#include "host/files.h"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <fstream>

#include "host/error.h"

namespace tessera {

namespace fs = std::filesystem;

std::string uniqueName(std::string_view stem) {
  static std::atomic<unsigned> counter{0};
  return fmt::format("{}.{}-{}.tmp", stem, getpid(), counter++);
}

bool writeBeside(const fs::path& path, std::string_view text) {
  std::error_code error;
  fs::create_directories(path.parent_path(), error);
  const fs::path beside = path.parent_path() / uniqueName(path.filename().string());
  std::ofstream file(beside, std::ios::binary);
  file.write(text.data(), static_cast<std::streamsize>(text.size()));
  file.close();
  if (file) fs::rename(beside, path, error);
  if (!file || error) {
    fs::remove(beside, error);
    return false;
  }
  return true;
}

TemporaryFolder::TemporaryFolder(const fs::path& parent, std::string_view stem) : path_(parent / uniqueName(stem)) {
  std::error_code error;
  fs::create_directories(path_, error);
  if (error) fail(fmt::format("{}: cannot be made: {}", path_.string(), error.message()));
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace tessera
