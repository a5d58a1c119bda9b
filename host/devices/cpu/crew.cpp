#include "host/devices/cpu/crew.h"

#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <tessera/error.h>

#include <algorithm>
#include <atomic>
#include <cfenv>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <system_error>
#include <thread>
#include <vector>

namespace tessera::devices::cpu {
namespace {

/// Rows say how many threads a frame had, so fewer than asked for are an error.
[[noreturn]] void failThread(std::size_t made, unsigned wanted, const std::system_error& error) {
  fail(fmt::format("cpu: thread {} of {} cannot be made: {}; --threads {} would do", made + 1, wanted,
                   error.code().message(), std::max<std::size_t>(made, 1)));
}

/// oneTBB makes its threads late, and ends the process where it cannot: so they are tried first.
void tryThreads(unsigned wanted) {
  std::mutex gate;
  std::vector<std::jthread> others;
  const std::unique_lock closed(gate);  // opened before they are waited for
  try {
    while (others.size() + 1 < wanted) others.emplace_back([&gate] { const std::lock_guard pass(gate); });
  } catch (const std::system_error& error) {
    failThread(others.size() + 1, wanted, error);
  }
}

class TbbCrew final : public Crew {
 public:
  explicit TbbCrew(unsigned threads) : arena_(threads == 0 ? tbb::task_arena::automatic : static_cast<int>(threads)) {
    // The arena is an upper bound; its workers come from a pool that ends at the number of cores unless it is told
    // otherwise.
    if (threads > tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism))
      more_.emplace(tbb::global_control::max_allowed_parallelism, threads);
    arena_.initialize();
    tryThreads(this->threads());
  }
  unsigned threads() const override { return static_cast<unsigned>(arena_.max_concurrency()); }
  void run(const std::function<void()>& work) override {
    arena_.execute([&] {
      tbb::parallel_for(
          0u, threads(), [&](unsigned) { work(); }, tbb::simple_partitioner());
    });
  }

 private:
  std::optional<tbb::global_control> more_;
  tbb::task_arena arena_;
};

class PlainCrew final : public Crew {
 public:
  explicit PlainCrew(unsigned threads) {
    const unsigned wanted = threads != 0 ? threads : std::max(1u, std::thread::hardware_concurrency());
    try {
      while (others_.size() + 1 < wanted) others_.emplace_back([this] { serve(); });
    } catch (const std::system_error& error) {
      leave();
      failThread(others_.size() + 1, wanted, error);
    }
  }
  ~PlainCrew() override { leave(); }
  unsigned threads() const override { return static_cast<unsigned>(others_.size()) + 1; }
  void run(const std::function<void()>& work) override {
    {
      const std::lock_guard lock(mutex_);
      work_ = &work;
      ++round_;
      busy_ = others_.size();
    }
    changed_.notify_all();
    work();
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return busy_ == 0; });
  }

 private:
  void leave() {
    {
      const std::lock_guard lock(mutex_);
      leaving_ = true;
    }
    changed_.notify_all();
  }
  void serve() {
    std::unique_lock lock(mutex_);
    for (std::uint64_t seen = 0;;) {
      changed_.wait(lock, [&] { return leaving_ || round_ != seen; });
      if (leaving_) return;
      seen = round_;
      const std::function<void()>* work = work_;
      lock.unlock();
      (*work)();
      lock.lock();
      if (--busy_ == 0) changed_.notify_all();
    }
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  const std::function<void()>* work_ = nullptr;
  std::uint64_t round_ = 0;
  std::size_t busy_ = 0;
  bool leaving_ = false;
  std::vector<std::jthread> others_;  ///< last, so that they end before what they use is gone
};

/// Kernels run with IEEE rounding and denormals, whatever the caller's thread was set to.
class ExactFloats {
 public:
  ExactFloats() { std::fegetenv(&before_), std::fesetenv(FE_DFL_ENV); }
  ~ExactFloats() { std::fesetenv(&before_); }
  ExactFloats(const ExactFloats&) = delete;

 private:
  std::fenv_t before_;
};

using Clock = std::chrono::steady_clock;

constexpr std::chrono::microseconds kPieceTime{10};  // hand-out and clock cost about 50 ns: half a percent of it

}  // namespace

std::unique_ptr<Crew> makeTbbCrew(unsigned threads) { return std::make_unique<TbbCrew>(threads); }
std::unique_ptr<Crew> makePlainCrew(unsigned threads) { return std::make_unique<PlainCrew>(threads); }

void spread(Crew& crew, std::uint32_t count, const std::function<void(std::uint32_t, std::uint32_t)>& body) {
  std::atomic<std::uint64_t> next{0};  // 64 bits: every thread may add a piece once all is handed out
  std::mutex failureMutex;
  std::exception_ptr failure;
  const unsigned threads = crew.threads();
  const auto drain = [&] {
    const ExactFloats exact;
    Clock::time_point before = Clock::now();
    for (std::uint64_t piece = 1;;) {
      const std::uint64_t done = next.load(std::memory_order_relaxed);
      if (done >= count) return;
      // Towards the end a piece is at most half a thread's share of what is left.
      piece = std::clamp<std::uint64_t>(piece, 1, (count - done) / (2 * threads) + 1);
      const std::uint64_t begin = next.fetch_add(piece, std::memory_order_relaxed);
      if (begin >= count) return;
      try {
        body(static_cast<std::uint32_t>(begin),
             static_cast<std::uint32_t>(std::min<std::uint64_t>(begin + piece, count)));
      } catch (...) {
        const std::lock_guard lock(failureMutex);
        if (!failure) failure = std::current_exception();
        next = count;
      }
      const Clock::time_point now = Clock::now();
      piece = now - before < kPieceTime ? piece * 2 : piece / 2;
      before = now;
    }
  };
  if (count == 1 || threads == 1)
    drain();
  else if (count != 0)
    crew.run(drain);
  if (failure) std::rethrow_exception(failure);
}

}  // namespace tessera::devices::cpu
