// Names for what is not finished: new, one's own, and cleared when whoever made them is gone.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string_view>

namespace tessera::support {

/// A new file or folder `STEM.PID-RANDOM.tmp`, removed at the end with all that is in it. It is locked (flock) as long
/// as it is in use, so that clearTemporaries() can tell what a killed run has left, on whichever machine that ran.
class Temporary {
 public:
  enum Kind { kFile, kFolder };
  /// Throws std::system_error if it cannot be made. A folder is its owner's alone.
  Temporary(const std::filesystem::path& parent, std::string_view stem, Kind kind, mode_t mode = 0666);
  ~Temporary();
  Temporary(const Temporary&) = delete;
  const std::filesystem::path& path() const { return path_; }
  int descriptor() const { return lock_; }  ///< of a file: open for writing
  /// It has been renamed, so that nothing is left to remove.
  void renamed() { path_.clear(); }

 private:
  std::filesystem::path path_;
  int lock_ = -1;
};

/// Removes what killed runs of this user left in `parent` under names that Temporary gives to `stem`.
void clearTemporaries(const std::filesystem::path& parent, std::string_view stem);

}  // namespace tessera::support
