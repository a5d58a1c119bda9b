// Files and words.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "datasets/numbers.h"

namespace tessera {

/// The bytes of a whole file.
class FileBytes {
 public:
  /// Throws kUsage when the file is missing, a folder, unreadable or empty.
  explicit FileBytes(const std::filesystem::path& path);
  std::string_view view() const { return {bytes_.get(), size_}; }

 private:
  struct Free {
    void operator()(char* bytes) const { std::free(bytes); }
  };
  std::unique_ptr<char[], Free> bytes_;
  std::size_t size_ = 0;
};
/// The same in a string.
std::string readFile(const std::filesystem::path& path);

/// The text without a byte order mark of UTF-8. Throws kUsage for UTF-16 and UTF-32.
std::string_view plainText(const std::string& name, std::string_view text);

/// ASCII letters made small.
std::string lowerCase(std::string_view text);

/// A word of a file as a message shows it: in quotes, cut where it is long, without control characters.
std::string shown(std::string_view word);

}  // namespace tessera
