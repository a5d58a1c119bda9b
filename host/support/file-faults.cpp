#include "host/support/file-faults.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cerrno>

#include "host/support/output-place.h"

namespace tessera::support {

std::string whyNoFile(const std::filesystem::path& path) {
  struct stat about {};
  if (stat(path.c_str(), &about) == 0) return whyNoFile(about.st_mode);
  return errno == ENOENT || errno == ENOTDIR ? "no such file" : causeOf(errno);
}

std::string whyNoFile(mode_t mode) {
  if (S_ISREG(mode)) return "";
  const char* const what = S_ISDIR(mode) ? "folder" : S_ISFIFO(mode) ? "pipe" : S_ISSOCK(mode) ? "socket" : "device";
  return fmt::format("is a {}; a file would be right", what);
}

ExitCode codeOf(int error) {
  constexpr std::array kShortages{ENOSPC, EDQUOT, EFBIG, EIO, EMFILE, ENFILE, ENOMEM};
  return std::ranges::find(kShortages, error) != kShortages.end() ? ExitCode::kFailure : ExitCode::kUsage;
}

}  // namespace tessera::support
