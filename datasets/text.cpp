#include "datasets/text.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>

#include "datasets/huge-pages.h"
#include "host/error.h"

namespace tessera {

FileBytes::FileBytes(const std::filesystem::path& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const auto failed = [&](const char* cause) { failUsage(fmt::format("{}: {}", path.string(), cause)); };
  if (file < 0) failed(errno == ENOENT || errno == ENOTDIR ? "no such file" : std::strerror(errno));
  struct Closer {
    int file;
    ~Closer() { close(file); }
  } const closer{file};
  struct stat status {};
  if (fstat(file, &status) != 0) failed(std::strerror(errno));
  if (S_ISDIR(status.st_mode)) failed("is a folder; a file would be right");
  if (S_ISBLK(status.st_mode) || (S_ISCHR(status.st_mode) && isatty(file) != 1))
    failed("is a device; a file would be right");
  // One byte more than the file has, so that its end is met without growing; a pipe tells no size.
  std::size_t capacity = 0, wanted = static_cast<std::size_t>(std::max<off_t>(status.st_size, 1 << 16)) + 1;
  for (;;) {
    if (size_ == capacity) {
      capacity = std::max(wanted, 2 * capacity);
      auto* const grown = static_cast<char*>(std::realloc(bytes_.get(), capacity));
      if (!grown) throw std::bad_alloc();
      static_cast<void>(bytes_.release());
      bytes_.reset(grown);
      preferHugePages(grown, capacity);
    }
    const ssize_t got = read(file, bytes_.get() + size_, capacity - size_);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) failed(std::strerror(errno));
    if (got == 0) break;
    size_ += static_cast<std::size_t>(got);
  }
  if (size_ == 0) failed("is empty");
}

std::string readFile(const std::filesystem::path& path) { return std::string(FileBytes(path).view()); }

std::string_view plainText(const std::string& name, std::string_view text) {
  using namespace std::string_view_literals;
  const bool wide =
      text.starts_with("\xff\xfe"sv) || text.starts_with("\xfe\xff"sv) || text.starts_with("\0\0\xfe\xff"sv);
  if (wide) failUsage(fmt::format("{}: is UTF-16 or UTF-32; UTF-8 would be right", name));
  return text.substr(text.starts_with("\xef\xbb\xbf"sv) ? 3 : 0);
}

std::string lowerCase(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

std::string shown(std::string_view word) {
  constexpr std::size_t kMost = 60;
  std::string text(word.substr(0, kMost));
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < ' ' || c == 0x7f; }, '?');
  return fmt::format("'{}{}'", text, word.size() > kMost ? "..." : "");
}

}  // namespace tessera
