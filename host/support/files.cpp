#include "host/support/files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <tessera/error.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <system_error>

#include "host/support/file-faults.h"
#include "host/support/output-place.h"
#include "host/support/temporary.h"

namespace tessera::support {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void failFolder(const fs::path& folder, int error) {
  throw WriteError(
      codeOf(error),
      fmt::format("{}: cannot be written: {}; room there, or another folder (TMPDIR for temporary files, TESSERA_CACHE "
                  "for compiled "
                  "kernels), would do",
                  folder.string(), causeOf(error)));
}

}  // namespace

fs::path temporaryRoot() {
  const char* const named = std::getenv("TMPDIR");
  const fs::path root = named != nullptr && *named != '\0' ? named : "/tmp";
  struct stat about {};
  if (stat(root.c_str(), &about) != 0) failFolder(root, errno);
  if (!S_ISDIR(about.st_mode)) failFolder(root, ENOTDIR);
  return root;
}

void writeInto(const fs::path& path, std::string_view text) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0644);
  if (file < 0) failFolder(path.parent_path(), errno);
  const int error = writeBytes(file, text);
  close(file);
  if (error != 0) failFolder(path.parent_path(), error);
}

int faultOf(const fs::path& folder, std::string_view said) try {
  for (const int error : {ENOSPC, EDQUOT, EROFS, EFBIG, EIO})
    if (said.find(causeOf(error)) != std::string_view::npos) return error;
  Temporary file(folder, "try", Temporary::kFile);
  return writeBytes(file.descriptor(), std::string(1 << 18, 'x'));
} catch (const std::system_error& error) {
  return error.code().value();
}

void checkWritten(const fs::path& folder, std::string_view said) {
  if (const int error = faultOf(folder, said); error != 0) failFolder(folder, error);
}

TemporaryFolder::TemporaryFolder(const fs::path& parent, std::string_view stem) try {
  fs::create_directories(parent);
  clearTemporaries(parent, stem);
  folder_ = std::make_unique<Temporary>(parent, stem, Temporary::kFolder);
} catch (const std::system_error& error) {
  failFolder(parent, error.code().value());
}

TemporaryFolder::~TemporaryFolder() = default;

const fs::path& TemporaryFolder::path() const { return folder_->path(); }

}  // namespace tessera::support
