// A limit on the time of a frame, kept by a thread of its own: a frame that hangs cannot keep it itself.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>

namespace tessera::harness {

/// Looks four times a second, or ten times in the shortest limit; between that nothing runs beside the frame.
class Watchdog {
 public:
  /// `late` is called on the watchdog's thread and has to end the process.
  Watchdog(double shortestLimitS, std::function<void(double limitS)> late);
  ~Watchdog();
  Watchdog(const Watchdog&) = delete;

  /// Watches while it lives. One at a time.
  class Watch {
   public:
    Watch(Watchdog& dog, double limitS);
    ~Watch();
    Watch(const Watch&) = delete;

   private:
    Watchdog& dog_;
  };

 private:
  void run(std::stop_token stop);

  const std::chrono::nanoseconds interval_;
  const std::function<void(double)> late_;
  std::atomic<std::int64_t> end_;  ///< of the steady clock, ns; or kNothing, kLate
  std::atomic<double> limitS_{0};
  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::jthread thread_;  ///< last, so that it ends before what it reads is gone
};

}  // namespace tessera::harness
