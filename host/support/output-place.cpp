#include "host/support/output-place.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/stat.h>
#include <poll.h>
#include <tessera/error.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <system_error>
#include <thread>

#include "host/support/file-faults.h"

namespace tessera::support {
namespace {

namespace fs = std::filesystem;

constexpr int kMostLinks = 40;  // as Linux has it

[[noreturn]] void refuse(const fs::path& name, const std::string& why) {
  failUsage(fmt::format("{}: {}", name.string(), why));
}

/// The number of a descriptor that `path` names; nothing where it names another thing.
std::optional<int> descriptorOf(const fs::path& path) {
  std::error_code error;
  const fs::path folder = fs::canonical(path.parent_path(), error);
  if (error || folder.filename() != "fd" || !folder.native().starts_with(fmt::format("/proc/{}/", getpid()))) return {};
  const std::string number = path.filename().string();
  int descriptor = -1;
  const auto [end, problem] = std::from_chars(number.data(), number.data() + number.size(), descriptor);
  if (problem != std::errc() || end != number.data() + number.size()) return {};
  return descriptor;
}

void checkDescriptor(const OutputPlace& place) {
  const int flags = fcntl(place.descriptor, F_GETFL);
  if (flags < 0) refuse(place.name, "this descriptor is not open");
  if ((flags & O_ACCMODE) == O_RDONLY) refuse(place.name, "is open for reading only");
  if (place.there && S_ISDIR(place.there->st_mode)) refuse(place.name, "is a folder; a file would do");
}

/// A file that is a mount of its own (a container's) cannot be renamed over.
bool isMount(const fs::path& file) {
  struct statx about {};
  return statx(AT_FDCWD, file.c_str(), 0, 0, &about) == 0 &&
         (about.stx_attributes & about.stx_attributes_mask & STATX_ATTR_MOUNT_ROOT) != 0;
}

}  // namespace

std::string causeOf(int error) { return std::generic_category().message(error); }

OutputPlace outputPlace(const fs::path& target) {
  OutputPlace place{.name = target, .file = target, .descriptor = -1, .there = {}};
  if (target.empty()) failUsage("an output has no name; a file name, or - for stdout, would do");
  if (target == "-") place.descriptor = STDOUT_FILENO;
  std::error_code error;
  for (int links = 0; place.descriptor < 0; ++links) {
    if (const auto descriptor = descriptorOf(place.file)) {
      place.descriptor = *descriptor;
      break;
    }
    const fs::path next = fs::read_symlink(place.file, error);
    if (error) break;  // no link
    if (links == kMostLinks) refuse(target, causeOf(ELOOP));
    place.file = place.file.parent_path() / next;
  }
  struct stat about {};
  const bool open = place.descriptor >= 0;
  if ((open ? fstat(place.descriptor, &about) : stat(place.file.c_str(), &about)) == 0)
    place.there = about;
  else if (!open && errno != ENOENT)
    refuse(target, causeOf(errno));
  if (open) {
    place.file.clear();
    checkDescriptor(place);
    return place;
  }
  if (place.there && S_ISDIR(place.there->st_mode)) refuse(target, "is a folder; a file name would do");
  if (!place.file.has_filename()) refuse(target, "is no name of a file");
  if (place.there && S_ISSOCK(place.there->st_mode)) refuse(target, "is a socket; a file or a pipe would do");
  if (place.there && faccessat(AT_FDCWD, place.file.c_str(), W_OK, AT_EACCESS) != 0)
    refuse(target, fmt::format("cannot be written: {}", causeOf(errno)));
  if (place.isFile() && !place.there) checkBeside(place);
  return place;
}

void checkBeside(const OutputPlace& place) {
  const fs::path folder = folderOf(place.file);
  struct stat about {};
  if (stat(folder.c_str(), &about) != 0)
    refuse(place.name, errno == ENOENT ? fmt::format("the folder {} does not exist", folder.string())
                                       : fmt::format("{}: {}", folder.string(), causeOf(errno)));
  if (!S_ISDIR(about.st_mode)) refuse(place.name, fmt::format("{} is not a folder", folder.string()));
  if (faccessat(AT_FDCWD, folder.c_str(), W_OK | X_OK, AT_EACCESS) != 0)
    refuse(place.name, fmt::format("the folder {} cannot be written: {}; a file is written beside its name first",
                                   folder.string(), causeOf(errno)));
  if (!place.there) return;
  if (isMount(place.file)) refuse(place.name, "is mounted there by itself; a name in a folder would do");
  const bool othersMayNot = (about.st_mode & S_ISVTX) != 0 && geteuid() != 0 && about.st_uid != geteuid();
  if (othersMayNot && place.there->st_uid != geteuid())
    refuse(place.name, fmt::format("belongs to another user, and {} lets nobody else replace it", folder.string()));
}

int openStream(const OutputPlace& place) {
  if (place.descriptor >= 0) {
    std::fflush(nullptr);  // what was printed comes first
    const int copy = fcntl(place.descriptor, F_DUPFD_CLOEXEC, 0);
    if (copy < 0) refuse(place.name, causeOf(errno));
    return copy;
  }
  const bool pipe = place.there && S_ISFIFO(place.there->st_mode);
  const auto end = std::chrono::steady_clock::now() + kPipeTime;
  for (;;) {
    const int stream = open(place.file.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC | (pipe ? O_NONBLOCK : 0));
    if (stream >= 0) {
      if (pipe) fcntl(stream, F_SETFL, fcntl(stream, F_GETFL) & ~O_NONBLOCK);
      return stream;
    }
    if (errno == EINTR) continue;
    if (!pipe || errno != ENXIO) refuse(place.name, fmt::format("cannot be opened: {}", causeOf(errno)));
    if (std::chrono::steady_clock::now() > end)
      refuse(place.name,
             fmt::format("is a pipe that nothing has read for {} s; start its reader first", kPipeTime.count()));
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

int writeBytes(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t put = write(descriptor, bytes.data(), bytes.size());
    if (put > 0) {
      bytes.remove_prefix(static_cast<std::size_t>(put));
    } else if (put < 0 && errno == EAGAIN) {
      pollfd ready{descriptor, POLLOUT, 0};
      poll(&ready, 1, -1);
    } else if (put == 0 || errno != EINTR) {
      return put == 0 ? ENOSPC : errno;
    }
  }
  return 0;
}

void writeAll(int descriptor, std::string_view bytes, const fs::path& name) {
  if (const int error = writeBytes(descriptor, bytes); error != 0) failWriting(name, causeOf(error));
}

bool synced(int descriptor) {
  return fsync(descriptor) == 0 || errno == EINVAL || errno == ENOSYS || errno == EOPNOTSUPP;
}

void failWriting(const fs::path& name, const std::string& cause) {
  fail(fmt::format("{}: could not be written: {}", name == "-" ? "stdout" : name.string(), cause));
}

fs::path folderOf(const fs::path& file) { return file.has_parent_path() ? file.parent_path() : fs::path("."); }

}  // namespace tessera::support
