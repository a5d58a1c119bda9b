// Files and words.
#pragma once

#include <tessera/error.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "datasets/huge-pages.h"
#include "datasets/numbers.h"

namespace tessera::datasets {

/// A file that is read once, from its beginning to its end.
class InputFile {
 public:
  /// Throws kUsage when the file is missing, a folder, a device or unreadable, or a pipe that finds no writer within
  /// ten seconds; kFailure for a shortage.
  explicit InputFile(std::filesystem::path path);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  const std::string& name() const { return path_.native(); }
  /// Bytes; a pipe tells 0.
  std::uint64_t size() const { return size_; }
  /// The next bytes; fewer than asked for at the end of the file alone.
  std::size_t read(char* into, std::size_t bytes);

 private:
  [[noreturn]] void fail(const std::string& cause, ExitCode code = ExitCode::kUsage) const;
  void awaitWriter();

  std::filesystem::path path_;
  int file_ = -1;
  std::uint64_t size_ = 0;
  std::optional<char> first_;  ///< read while the pipe's writer was looked for
};

/// The bytes of a whole file.
class FileBytes {
 public:
  /// Throws kUsage when the file is empty, too. `begun` are bytes that were read from it before.
  explicit FileBytes(InputFile& file, std::string_view begun = {});
  std::string_view view() const { return {bytes_.get(), size_}; }

 private:
  std::unique_ptr<char[], FreeMemory> bytes_;
  std::size_t size_ = 0;
};
/// The same in a string.
std::string readFile(const std::filesystem::path& path);

/// The text without a byte order mark of UTF-8. Throws kUsage for UTF-16 and UTF-32.
std::string_view plainText(const std::string& name, std::string_view text);

/// A word of a file as a message shows it: in quotes, cut where it is long, without control characters.
std::string shown(std::string_view word);

}  // namespace tessera::datasets
