// What is wrong with a name that should lead to a file, in the same words and with the same exit code everywhere.
#pragma once

#include <sys/types.h>
#include <tessera/error.h>

#include <chrono>
#include <filesystem>
#include <string>

namespace tessera::support {

/// "" for a file, through links too; else "no such file", "is a folder; a file would be right", or why it is not known.
std::string whyNoFile(const std::filesystem::path& path);
/// The same by the mode that stat() gives.
std::string whyNoFile(mode_t mode);

/// How long a pipe has to find who reads what is written to it, or writes what is read from it.
inline constexpr std::chrono::seconds kPipeTime{10};

/// kFailure for a shortage (of room, descriptors, memory) or a broken disk, which another run may not meet; kUsage for
/// what is wrong with the name, such as a permission.
ExitCode codeOf(int error);

}  // namespace tessera::support
