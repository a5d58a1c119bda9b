#include "datasets/text.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <tessera/error.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <new>

#include "datasets/huge-pages.h"
#include "host/support/file-faults.h"
#include "host/support/output-place.h"

namespace tessera::datasets {

InputFile::InputFile(std::filesystem::path path) : path_(std::move(path)) {
  // Opening a pipe would wait for its writer without an end.
  file_ = open(path_.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK);
  if (file_ < 0) {
    const int error = errno;
    const std::string why = support::whyNoFile(path_);  // no file there, or a socket, which cannot be opened
    fail(why.empty() ? support::causeOf(error) : why, support::codeOf(error));
  }
  try {
    struct stat status {};
    if (fstat(file_, &status) != 0) fail(support::causeOf(errno), support::codeOf(errno));
    const bool pipe = S_ISFIFO(status.st_mode), terminal = S_ISCHR(status.st_mode) && isatty(file_) == 1;
    if (const std::string why = support::whyNoFile(status.st_mode); !why.empty() && !pipe && !terminal) fail(why);
    if (S_ISREG(status.st_mode)) size_ = static_cast<std::uint64_t>(status.st_size);
    if (pipe) awaitWriter();
    fcntl(file_, F_SETFL, fcntl(file_, F_GETFL) & ~O_NONBLOCK);
  } catch (...) {
    close(file_);
    throw;
  }
}

InputFile::~InputFile() { close(file_); }

void InputFile::fail(const std::string& cause, ExitCode code) const {
  throw Error(code, fmt::format("{}: {}", name(), cause));
}

void InputFile::awaitWriter() {
  const auto end = std::chrono::steady_clock::now() + support::kPipeTime;
  pollfd pipe{file_, POLLIN, 0};
  for (auto now = end - support::kPipeTime; now < end; now = std::chrono::steady_clock::now()) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - now);
    if (poll(&pipe, 1, static_cast<int>(left.count())) > 0) return;  // bytes, or a writer that is gone
  }
  // Without a writer a pipe is at its end; with one that has written nothing yet there is nothing to read.
  char byte = 0;
  const ssize_t got = ::read(file_, &byte, 1);
  if (got == 0)
    fail(fmt::format("is a pipe that nothing has opened to write to for {} s; start its writer first",
                     support::kPipeTime.count()));
  if (got == 1) first_ = byte;
}

std::size_t InputFile::read(char* into, std::size_t bytes) {
  std::size_t all = 0;
  if (first_ && bytes > 0) {
    into[all++] = *first_;
    first_.reset();
  }
  while (all < bytes) {
    const ssize_t got = ::read(file_, into + all, bytes - all);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail(support::causeOf(errno), support::codeOf(errno));
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

namespace {

constexpr std::size_t kLookedAt = 64;  // bytes; where binary data follows a text header it begins later

/// UTF-16 or UTF-32 without a mark: most bytes at odd places are zero, or most at even ones, and half of the others at
/// most are.
bool looksWide(std::string_view text) {
  std::array<std::size_t, 2> zeros{};
  for (std::size_t k = 0; k < text.size(); ++k) zeros[k % 2] += text[k] == '\0';
  const auto [few, many] = std::ranges::minmax(zeros);
  const std::size_t half = text.size() / 2;
  return half >= 2 && 4 * many >= 3 * half && 2 * few <= half;
}

}  // namespace

std::string_view plainText(const std::string& name, std::string_view text) {
  using namespace std::string_view_literals;
  const bool marked =
      text.starts_with("\xff\xfe"sv) || text.starts_with("\xfe\xff"sv) || text.starts_with("\0\0\xfe\xff"sv);
  if (marked || looksWide(text.substr(0, kLookedAt)))
    failUsage(fmt::format("{}: is UTF-16 or UTF-32; UTF-8 would be right", name));
  return text.substr(text.starts_with("\xef\xbb\xbf"sv) ? 3 : 0);
}

std::string shown(std::string_view word) {
  constexpr std::size_t kMost = 60;
  std::string text(word.substr(0, kMost));
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < ' ' || c == 0x7f; }, '?');
  return fmt::format("'{}{}'", text, word.size() > kMost ? "..." : "");
}

}  // namespace tessera::datasets
