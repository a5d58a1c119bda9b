#include "host/support/temporary.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <random>
#include <string>
#include <system_error>
#include <vector>

namespace tessera::support {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kStemBytes = 100;  // names end at 255 bytes, on some file systems at 143
constexpr std::size_t kRandomLetters = 8;
constexpr std::string_view kEnd = ".tmp";

/// Cut where a character of UTF-8 ends.
std::string_view cut(std::string_view stem) {
  if (stem.size() <= kStemBytes) return stem;
  std::size_t length = kStemBytes;
  while (length > 0 && (stem[length] & 0xc0) == 0x80) --length;
  return stem.substr(0, length);
}

std::string randomLetters() {
  static constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyz0123456789";
  std::random_device random;
  std::string text(kRandomLetters, ' ');
  for (char& letter : text) letter = kLetters[random() % kLetters.size()];
  return text;
}

bool isTemporary(std::string_view name, std::string_view stem) {
  if (!name.starts_with(stem) || !name.ends_with(kEnd) || name.size() < stem.size() + kEnd.size() + 4) return false;
  const std::string_view middle = name.substr(stem.size(), name.size() - stem.size() - kEnd.size());
  const auto isDigit = [](char c) { return c >= '0' && c <= '9'; };
  const auto dash = std::find_if_not(middle.begin() + 1, middle.end(), isDigit);
  return middle[0] == '.' && dash != middle.begin() + 1 && dash != middle.end() && *dash == '-' &&
         dash + 1 != middle.end() &&
         std::all_of(dash + 1, middle.end(), [&](char c) { return isDigit(c) || (c >= 'a' && c <= 'z'); });
}

/// Whether the descriptor's file still has a name.
bool isThere(int descriptor) {
  struct stat about {};
  return fstat(descriptor, &about) == 0 && about.st_nlink > 0;
}

}  // namespace

Temporary::Temporary(const fs::path& parent, std::string_view stem, Kind kind, mode_t mode) {
  for (;;) {
    path_ = parent / fmt::format("{}.{}-{}{}", cut(stem), getpid(), randomLetters(), kEnd);
    if (kind == kFolder) {
      if (mkdir(path_.c_str(), 0700) != 0) {
        if (errno == EEXIST) continue;
        throw std::system_error(errno, std::generic_category());
      }
      lock_ = open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
      if (lock_ < 0 && errno == ENOENT) continue;  // another run has cleared it before it was locked
    } else {
      lock_ = open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, mode);
      if (lock_ < 0 && errno == EEXIST) continue;
    }
    if (lock_ < 0) throw std::system_error(errno, std::generic_category());
    // A file system without locks has its leftovers stay. Between open and here another run may have cleared it.
    if (flock(lock_, LOCK_EX) != 0 || isThere(lock_)) return;
    close(lock_);
  }
}

Temporary::~Temporary() {
  std::error_code ignored;
  if (!path_.empty()) fs::remove_all(path_, ignored);
  close(lock_);
}

void clearTemporaries(const fs::path& parent, std::string_view stem) {
  std::error_code ignored;
  std::vector<fs::path> found;
  fs::directory_iterator entries(parent, ignored);
  for (; entries != fs::directory_iterator(); entries.increment(ignored))
    if (isTemporary(entries->path().filename().native(), cut(stem))) found.push_back(entries->path());
  for (const fs::path& path : found) {
    const int lock = open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (lock < 0) continue;
    struct stat about {};
    if (fstat(lock, &about) == 0 && about.st_uid == geteuid() && (S_ISREG(about.st_mode) || S_ISDIR(about.st_mode)) &&
        flock(lock, LOCK_EX | LOCK_NB) == 0)
      fs::remove_all(path, ignored);
    close(lock);
  }
}

}  // namespace tessera::support
