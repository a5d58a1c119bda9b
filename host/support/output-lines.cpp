#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <tessera/error.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <thread>

#include "host/support/files.h"
#include "host/support/output-place.h"

namespace tessera::support {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds kLockTime{10};

/// Held while a line is added, so that what is truncated away is ours alone.
void lock(int file, const fs::path& name) {
  const auto end = std::chrono::steady_clock::now() + kLockTime;
  while (flock(file, LOCK_EX | LOCK_NB) != 0) {
    if (errno != EWOULDBLOCK && errno != EINTR) return;  // a file system without locks
    if (std::chrono::steady_clock::now() > end)
      fail(fmt::format("{}: another program has held its lock for {} s; another file would do", name.string(),
                       kLockTime.count()));
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

}  // namespace

struct AppendedFile::State {
  OutputPlace place;
  int stream = -1;
  explicit State(const fs::path& target) : place(outputPlace(target)) {
    if (!place.isFile())
      stream = openStream(place);
    else if (!place.there)
      OutputFile{target};  // a file can be made there
  }
  ~State() {
    if (stream >= 0) close(stream);
  }
  State(const State&) = delete;

  void appendToFile(std::string text) {
    const auto failed = [&](int error) { failWriting(place.name, causeOf(error)); };
    const int file = open(place.file.c_str(), O_RDWR | O_APPEND | O_CREAT | O_CLOEXEC | O_NOCTTY, 0666);
    if (file < 0) failed(errno);
    const std::unique_ptr<const int, void (*)(const int*)> closing(&file, [](const int* number) { close(*number); });
    lock(file, place.name);
    struct stat about {};
    if (fstat(file, &about) != 0) failed(errno);
    char last = '\n';
    // A line that another program left half is not ours to cut, nor to go on with.
    if (about.st_size > 0 && pread(file, &last, 1, about.st_size - 1) == 1 && last != '\n') text.insert(0, 1, '\n');
    // In one write, where there is room; where there is not, writing the rest tells why.
    int error = writeBytes(file, text);
    if (error == 0 && !synced(file)) error = errno;
    if (error == 0) return;
    struct stat grown {};
    if ((fstat(file, &grown) != 0 || grown.st_size != about.st_size) && ftruncate(file, about.st_size) != 0)
      fail(fmt::format("{}: could not be written: {}; its last line is cut short, and could not be taken away: {}",
                       place.name.string(), causeOf(error), causeOf(errno)));
    if (!place.there && about.st_size == 0) unlink(place.file.c_str());
    failed(error);
  }
};

AppendedFile::AppendedFile(const fs::path& target) : state_(std::make_unique<State>(target)) {}
AppendedFile::~AppendedFile() = default;
AppendedFile::AppendedFile(AppendedFile&&) noexcept = default;

void AppendedFile::append(std::string_view lines) {
  std::string text(lines);
  if (text.empty() || text.back() != '\n') text += '\n';
  if (state_->stream >= 0)
    writeAll(state_->stream, text, state_->place.name);
  else
    state_->appendToFile(std::move(text));
}

}  // namespace tessera::support
