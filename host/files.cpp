#include "host/files.h"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <fstream>
#include <system_error>

#include "host/error.h"
#include "host/temporary.h"

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

fs::path temporaryRoot() {
  const char* const named = std::getenv("TMPDIR");
  const fs::path root = named != nullptr && *named != '\0' ? named : "/tmp";
  std::error_code error;
  if (!fs::is_directory(root, error))
    fail(fmt::format("TMPDIR={}: {}; a folder with room in it would do", root.string(),
                     error ? error.message() : "is not a folder"));
  return root;
}

TemporaryFolder::TemporaryFolder(const fs::path& parent, std::string_view stem) try {
  fs::create_directories(parent);
  clearTemporaries(parent, stem);
  folder_ = std::make_unique<Temporary>(parent, stem, Temporary::kFolder);
} catch (const std::system_error& error) {
  fail(fmt::format("{}: no temporary folder can be made in it: {}", parent.string(), error.code().message()));
}

TemporaryFolder::~TemporaryFolder() = default;

const fs::path& TemporaryFolder::path() const { return folder_->path(); }

}  // namespace tessera
