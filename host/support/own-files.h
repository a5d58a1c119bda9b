// Files that this program keeps for itself and believes: compiled kernels, which run as the process does, what was
// found out about compilers, unpacked meshes.
#pragma once

#include <filesystem>
#include <string_view>

namespace tessera::support {

/// $TESSERA_CACHE, else $XDG_CACHE_HOME/tessera, else ~/.cache/tessera. Throws kUsage where none of them is set.
std::filesystem::path defaultCacheFolder();

/// Throws kUsage, with what would do, if somebody else than this user and root owns `path` or may write it. What is not
/// there is fine.
void checkOwn(const std::filesystem::path& path);

/// Makes the folder and those above it, for their owner alone to write. Throws std::system_error.
void makeOwnFolder(const std::filesystem::path& folder);

/// Takes from others the right to write. Throws std::system_error.
void makeOwn(const std::filesystem::path& path);

/// Writes a file beside its name and renames it over whatever is there. Throws std::system_error.
void writeOwn(const std::filesystem::path& path, std::string_view text);

/// Renames a file over whatever is there, a folder that somebody has put there too. Throws std::system_error.
void replaceOwn(const std::filesystem::path& made, const std::filesystem::path& path);

}  // namespace tessera::support
