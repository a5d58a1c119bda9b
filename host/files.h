// Files that appear whole or not at all.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace tessera {

/// A name that no other thread or process uses: `stem` with this process's number, a counter and ".tmp".
std::string uniqueName(std::string_view stem);

/// Writes `path` beside its name and renames it. False if that cannot be done; nothing is left behind then.
bool writeBeside(const std::filesystem::path& path, std::string_view text);

/// A new folder, removed with all that is in it at the end. Throws kFailure if it cannot be made.
class TemporaryFolder {
 public:
  TemporaryFolder(const std::filesystem::path& parent, std::string_view stem);
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace tessera
