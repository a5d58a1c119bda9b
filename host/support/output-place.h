// Where an output's bytes go: what its name leads to.
#pragma once

#include <sys/stat.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace tessera::support {

/// What a name leads to through symbolic links. Made, it has passed every check that needs no writing.
struct OutputPlace {
  std::filesystem::path name;        ///< as it was given, for messages
  std::filesystem::path file;        ///< where its links end; nothing for a descriptor
  int descriptor = -1;               ///< "-", /dev/stdout, /dev/fd/N, /proc/self/fd/N: this process's, already open
  std::optional<struct stat> there;  ///< what is there now

  /// A file, there already or not yet: written beside and renamed. Else bytes are written to what is there.
  bool isFile() const { return descriptor < 0 && (!there || S_ISREG(there->st_mode)); }
};

/// Throws kUsage, in one line with the cause, where nothing can be written.
OutputPlace outputPlace(const std::filesystem::path& target);

/// The same where a file cannot be renamed over what is there, or none can be made: its folder has to be writable, too.
void checkBeside(const OutputPlace& place);

/// Opens a device, pipe or descriptor to write to. A pipe has ten seconds to find its reader. Throws kUsage.
int openStream(const OutputPlace& place);

/// 0, or the error that left some of the bytes unwritten.
int writeBytes(int descriptor, std::string_view bytes);

/// Throws kFailure, with the name and the cause, unless all is written.
void writeAll(int descriptor, std::string_view bytes, const std::filesystem::path& name);

/// fsync. Some file systems have no such thing; others say here what they could not write: false, and errno is set.
bool synced(int descriptor);

/// Throws kFailure: the name, "-" being stdout, and the cause.
[[noreturn]] void failWriting(const std::filesystem::path& name, const std::string& cause);

std::string causeOf(int error);

/// That of a file, "." where its name has none.
std::filesystem::path folderOf(const std::filesystem::path& file);

}  // namespace tessera::support
