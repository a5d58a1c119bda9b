// A folder to write into, and a pipe's reader.
#pragma once

#include <filesystem>
#include <future>
#include <string>
#include <vector>

#include "host/support/files.h"

namespace tessera::test {

class Folder {
 public:
  std::filesystem::path operator/(const std::string& name) const { return folder_.path() / name; }
  void write(const std::string& name, const std::string& text) const;
  std::string read(const std::string& name) const;
  std::vector<std::string> names() const;  ///< sorted

 private:
  support::TemporaryFolder folder_{std::filesystem::temp_directory_path(), "tessera-files-test"};
};

/// All that comes out of a pipe until it is closed.
std::future<std::string> readPipe(const std::filesystem::path& pipe);

/// Files of this process end at so many bytes until the end; more is EFBIG.
class FileLimit {
 public:
  explicit FileLimit(unsigned long bytes);
  ~FileLimit();

 private:
  unsigned long before_;
};

}  // namespace tessera::test
