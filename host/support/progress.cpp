#include "host/support/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <system_error>

#include "host/support/terminal.h"

namespace tessera::support {
namespace {

std::atomic<bool> silent{false};
constexpr std::chrono::milliseconds kTerminalInterval{200};
constexpr std::chrono::seconds kLogInterval{10};

}  // namespace

Progress::Progress(std::string label, std::size_t total)
    : label_(std::move(label)), terminal_(isatty(STDERR_FILENO) == 1), total_(total) {
  try {
    watcher_ = std::jthread([this](std::stop_token stop) { watch(stop); });
  } catch (const std::system_error&) {
    // without a thread there is no progress to see; the work goes on
  }
}

void Progress::silence() { silent = true; }

bool Progress::silenced() { return silent; }

Progress::~Progress() {
  watcher_.request_stop();
  if (watcher_.joinable()) watcher_.join();
  if (drawn_ && terminal_) fmt::print(stderr, "\r\033[K");
}

void Progress::at(std::size_t done, const std::string& what, std::optional<double> left) {
  const std::lock_guard lock(mutex_);
  done_ = done;
  what_ = what;
  end_.reset();
  if (left) end_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(*left));
}

void Progress::watch(std::stop_token stop) {
  std::unique_lock lock(mutex_);
  while (!wake_.wait_until(lock, stop, next_, [] { return false; }) && !stop.stop_requested()) {
    draw();
    next_ = Clock::now() + (terminal_ ? Clock::duration(kTerminalInterval) : Clock::duration(kLogInterval));
  }
}

void Progress::draw() {
  if (silent) return;
  const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
  std::string line = label_;
  if (total_ != 0) line += fmt::format(" {}/{}", done_, total_);
  if (!what_.empty()) line += fmt::format(" ({})", what_);
  line += fmt::format(", {:.0f} s", seconds);
  if (end_) {
    const double left = std::chrono::duration<double>(*end_ - Clock::now()).count();
    line += fmt::format(", about {:.0f} s left", std::max(left, 0.0));
  } else if (done_ != 0 && done_ < total_) {
    const double left = seconds / static_cast<double>(done_) * static_cast<double>(total_ - done_);
    line += fmt::format(", about {:.0f} s left", left);
  }
  line = terminal_ ? "\r\033[K" + visible(line) : visible(line) + '\n';
  std::fputs(line.c_str(), stderr);
  std::fflush(stderr);
  drawn_ = true;
}

}  // namespace tessera::support
