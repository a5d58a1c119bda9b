#include "host/support/own-files.h"

#include <fmt/format.h>
#include <pwd.h>
#include <sys/stat.h>
#include <tessera/error.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "host/support/output-place.h"
#include "host/support/temporary.h"
#include "host/support/text.h"

namespace tessera::support {
namespace {

namespace fs = std::filesystem;

constexpr mode_t kOthersWrite = S_IWGRP | S_IWOTH;

[[noreturn]] void failed() { throw std::system_error(errno, std::generic_category()); }

std::string userName(uid_t user) {
  const passwd* const known = getpwuid(user);
  return known != nullptr ? known->pw_name : fmt::format("{}", user);
}

}  // namespace

fs::path defaultCacheFolder() {
  if (const std::string folder = environment("TESSERA_CACHE"); !folder.empty()) return folder;
  if (const std::string folder = environment("XDG_CACHE_HOME"); !folder.empty()) return fs::path(folder) / "tessera";
  if (const std::string folder = environment("HOME"); !folder.empty()) return fs::path(folder) / ".cache" / "tessera";
  failUsage("no folder for compiled kernels: set TESSERA_CACHE (XDG_CACHE_HOME and HOME are not set either)");
}

void checkOwn(const fs::path& path) {
  struct stat about {};
  if (stat(path.c_str(), &about) != 0) return;
  const std::string why = "and what is kept there runs as you do";
  if (about.st_uid != geteuid() && about.st_uid != 0)
    failUsage(fmt::format("{}: belongs to {}, {}; a TESSERA_CACHE of your own would do", path.string(),
                          userName(about.st_uid), why));
  if ((about.st_mode & kOthersWrite) != 0)
    failUsage(fmt::format(
        "{}: others can write it (mode {:03o}), {}; another TESSERA_CACHE, or `chmod -R go-w` if you trust what is in "
        "it, would do",
        path.string(), about.st_mode & 0777, why));
}

void makeOwnFolder(const fs::path& folder) {
  struct stat about {};
  if (folder.empty() || (stat(folder.c_str(), &about) == 0 && S_ISDIR(about.st_mode))) return;
  if (folder.has_relative_path()) makeOwnFolder(folder.parent_path());
  if (mkdir(folder.c_str(), 0755) == 0) return;
  const int error = errno;
  if (error == EEXIST && stat(folder.c_str(), &about) == 0) {  // another run, or no folder
    if (S_ISDIR(about.st_mode)) return;
    throw std::system_error(ENOTDIR, std::generic_category());
  }
  throw std::system_error(error, std::generic_category());
}

void makeOwn(const fs::path& path) {
  struct stat about {};
  if (stat(path.c_str(), &about) != 0 || chmod(path.c_str(), about.st_mode & 07777 & ~kOthersWrite) != 0) failed();
}

void writeOwn(const fs::path& path, std::string_view text) {
  Temporary file(path.parent_path(), path.filename().native(), Temporary::kFile, 0644);
  if (const int error = writeBytes(file.descriptor(), text); error != 0)
    throw std::system_error(error, std::generic_category());
  replaceOwn(file.path(), path);
  file.renamed();
}

void replaceOwn(const fs::path& made, const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(fs::symlink_status(path, error))) fs::remove_all(path);
  fs::rename(made, path);
}

}  // namespace tessera::support
