// Files that appear whole or not at all.
#pragma once

#include <tessera/error.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tessera::support {

/// An output that appears whole or not at all. A file, through symbolic links the one that they lead to, is written
/// beside and renamed; it keeps its mode. A device, a pipe, /dev/fd/N or "-" (stdout) is written to, from a file in the
/// temporary folder. Made before the work and kept: where nothing can be written, that is said before.
class OutputFile {
 public:
  /// Throws kUsage if nothing can be written there. A pipe has ten seconds to find its reader.
  explicit OutputFile(const std::filesystem::path& target);
  ~OutputFile();  ///< without commit() nothing has changed
  OutputFile(OutputFile&&) noexcept;
  const std::filesystem::path& target() const;  ///< as it was given, for messages
  /// The temporary file to write into, made by the first call.
  const std::filesystem::path& path();
  /// Why what a library wrote into path() is not whole, as well as its folder tells; else what the library `said`. A
  /// try tells more than libraries do of a full disk.
  std::string whyNotWhole(const std::string& said);
  /// Checks that the temporary file has these bytes (unless said, any number but none), syncs it, and renames or copies
  /// it. Throws kFailure with name and cause; what was there is still there then.
  void commit(std::optional<std::uintmax_t> bytes = {});

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// An output whose bytes are text.
void writeWhole(const std::filesystem::path& target, std::string_view text);

/// The same for a file that must not be there yet: false, and nothing is changed, where one is.
bool writeNew(const std::filesystem::path& target, std::string_view text);

/// Throws kUsage where writeWhole() could write nothing. It opens no pipe.
void checkWhole(const std::filesystem::path& target);

/// Throws kUsage if the folder, or the nearest one above it that is there, takes no new file. It makes no folder.
void checkOutputFolder(const std::filesystem::path& folder);

/// A file that lines are added to; a new one where there is none. Devices, pipes and "-" as for OutputFile.
class AppendedFile {
 public:
  /// Throws kUsage if nothing can be written there. It makes no file yet.
  explicit AppendedFile(const std::filesystem::path& target);
  ~AppendedFile();
  AppendedFile(AppendedFile&&) noexcept;
  /// By one write at the file's end. One that falls short is truncated away: kFailure with name and cause.
  void append(std::string_view lines);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Whether it is this process's stdout, under whatever name.
bool isStdout(const std::filesystem::path& target);

/// Throws kUsage where two outputs are one file, under whatever names, or one is an input. Devices may be named twice.
void checkApart(const std::vector<std::filesystem::path>& outputs, const std::vector<std::filesystem::path>& inputs);

/// A folder that others write into for us, such as compilers, cannot be written: the fault is none of theirs. kUsage
/// where it is none or may not be written, kFailure where there is no room.
class WriteError : public Error {
 public:
  using Error::Error;
};

/// A new folder, removed with all that is in it at the end. Throws WriteError with folder and cause if it cannot be
/// made.
class TemporaryFolder {
 public:
  TemporaryFolder(const std::filesystem::path& parent, std::string_view stem);
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const;

 private:
  std::unique_ptr<class Temporary> folder_;
};

/// $TMPDIR or /tmp. Throws WriteError, with what would do, if it is no folder.
std::filesystem::path temporaryRoot();

/// Writes a new file into a temporary folder. Throws WriteError.
void writeInto(const std::filesystem::path& path, std::string_view text);

/// The error that keeps files of a quarter of a mebibyte from `folder`, by what a program that failed there said or by
/// trying; 0 where there is none.
int faultOf(const std::filesystem::path& folder, std::string_view said);

/// For a program that failed and whose files go into `folder`: throws WriteError if the folder is why, by what the
/// program said or by trying.
void checkWritten(const std::filesystem::path& folder, std::string_view said);

}  // namespace tessera::support
