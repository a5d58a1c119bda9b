// Progress on stderr with the time left, for work that takes longer than two seconds.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace tessera::support {

/// Silent for two seconds; then drawn in place on a terminal, and as a line now and then elsewhere. Thread-safe.
class Progress {
 public:
  /// `total` steps; 0: not known, only the time that has passed is shown.
  Progress(std::string label, std::size_t total);
  ~Progress();
  Progress(const Progress&) = delete;
  /// From now on nothing is drawn, by any of them.
  static void silence();
  static bool silenced();

  /// `what` is being done now. `left`: seconds that the rest will take, where the caller knows better than by the share
  /// that is done; counted down until the next call.
  void at(std::size_t done, const std::string& what = "", std::optional<double> left = {});

 private:
  using Clock = std::chrono::steady_clock;
  void watch(std::stop_token stop);
  void draw();

  const std::string label_;
  const bool terminal_;
  const Clock::time_point start_ = Clock::now();
  Clock::time_point next_ = start_ + std::chrono::seconds(2);
  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::string what_;
  std::size_t done_ = 0, total_ = 0;
  std::optional<Clock::time_point> end_;  ///< as the caller expects it
  bool drawn_ = false;
  std::jthread watcher_;  ///< last, so that it ends before what it reads is gone
};

}  // namespace tessera::support
