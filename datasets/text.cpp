#include "datasets/text.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <tessera/error.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>

#include "datasets/huge-pages.h"

namespace tessera {

InputFile::InputFile(std::filesystem::path path) : path_(std::move(path)) {
  file_ = open(path_.c_str(), O_RDONLY | O_CLOEXEC);
  if (file_ < 0) fail(errno == ENOENT || errno == ENOTDIR ? "no such file" : std::strerror(errno));
  try {
    struct stat status {};
    if (fstat(file_, &status) != 0) fail(std::strerror(errno));
    if (S_ISDIR(status.st_mode)) fail("is a folder; a file would be right");
    if (S_ISBLK(status.st_mode) || (S_ISCHR(status.st_mode) && isatty(file_) != 1))
      fail("is a device; a file would be right");
    if (S_ISREG(status.st_mode)) size_ = static_cast<std::uint64_t>(status.st_size);
  } catch (...) {
    close(file_);
    throw;
  }
}

InputFile::~InputFile() { close(file_); }

void InputFile::fail(const char* cause) const { failUsage(fmt::format("{}: {}", name(), cause)); }

std::size_t InputFile::read(char* into, std::size_t bytes) {
  std::size_t all = 0;
  while (all < bytes) {
    const ssize_t got = ::read(file_, into + all, bytes - all);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail(std::strerror(errno));
    if (got == 0) break;
    all += static_cast<std::size_t>(got);
  }
  return all;
}

FileBytes::FileBytes(InputFile& file, std::string_view begun) {
  // One byte more than the file has, so that its end is met without growing; a pipe tells no size.
  std::size_t capacity = std::max<std::uint64_t>({file.size(), begun.size(), 1 << 16}) + 1;
  for (;;) {
    auto* const grown = static_cast<char*>(std::realloc(bytes_.get(), capacity));
    if (!grown) throw std::bad_alloc();
    static_cast<void>(bytes_.release());
    bytes_.reset(grown);
    preferHugePages(grown, capacity);
    if (size_ == 0) size_ = begun.copy(grown, begun.size());
    size_ += file.read(grown + size_, capacity - size_);
    if (size_ < capacity) break;
    capacity *= 2;
  }
  if (size_ == 0) failUsage(fmt::format("{}: is empty", file.name()));
}

std::string readFile(const std::filesystem::path& path) {
  InputFile file(path);
  return std::string(FileBytes(file).view());
}

std::string_view plainText(const std::string& name, std::string_view text) {
  using namespace std::string_view_literals;
  const bool wide =
      text.starts_with("\xff\xfe"sv) || text.starts_with("\xfe\xff"sv) || text.starts_with("\0\0\xfe\xff"sv);
  if (wide) failUsage(fmt::format("{}: is UTF-16 or UTF-32; UTF-8 would be right", name));
  return text.substr(text.starts_with("\xef\xbb\xbf"sv) ? 3 : 0);
}

std::string shown(std::string_view word) {
  constexpr std::size_t kMost = 60;
  std::string text(word.substr(0, kMost));
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < ' ' || c == 0x7f; }, '?');
  return fmt::format("'{}{}'", text, word.size() > kMost ? "..." : "");
}

}  // namespace tessera
