#include "experiments/harness/watchdog.h"

#include <fmt/format.h>
#include <tessera/error.h>

#include <algorithm>
#include <limits>
#include <system_error>

namespace tessera::harness {
namespace {

constexpr std::int64_t kNothing = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t kLate = -1;

std::int64_t nowNs() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

}  // namespace

Watchdog::Watchdog(double shortestLimitS, std::function<void(double)> late)
    : interval_(static_cast<std::int64_t>(std::clamp(shortestLimitS / 10, 0.001, 0.25) * 1e9)),
      late_(std::move(late)),
      end_(kNothing),
      thread_([this] {
        try {
          return std::jthread([this](std::stop_token stop) { run(stop); });
        } catch (const std::system_error& error) {
          fail(fmt::format("sweep: the thread that keeps time limits cannot be made: {}", error.code().message()));
        }
      }()) {}

Watchdog::~Watchdog() {
  thread_.request_stop();
  thread_.join();
}

void Watchdog::run(std::stop_token stop) {
  std::unique_lock lock(mutex_);
  while (!wake_.wait_for(lock, stop, interval_, [] { return false; }) && !stop.stop_requested()) {
    std::int64_t end = end_;
    // Whoever takes the end first decides: the frame that is done, or the limit.
    if (end != kNothing && nowNs() > end && end_.compare_exchange_strong(end, kLate)) late_(limitS_);
  }
}

Watchdog::Watch::Watch(Watchdog& dog, double limitS) : dog_(dog) {
  dog_.limitS_ = limitS;
  dog_.end_ = nowNs() + static_cast<std::int64_t>(std::min(limitS, 1e9) * 1e9);
}

Watchdog::Watch::~Watch() {
  if (dog_.end_.exchange(kNothing) != kLate) return;
  for (;;) std::this_thread::sleep_for(std::chrono::hours(1));  // late_ is about to end the process
}

}  // namespace tessera::harness
