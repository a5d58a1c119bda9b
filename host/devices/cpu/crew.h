// The threads of the CPU device: one piece of work, done by several threads together.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

namespace tessera::devices::cpu {

/// Calls `work` on up to `threads` threads at once, the caller among them, and waits for all. `work` must be whole on
/// any number of calls: threads that come late find nothing left. It must not throw.
class Crew {
 public:
  virtual ~Crew() = default;
  virtual void run(const std::function<void()>& work) = 0;
  virtual unsigned threads() const = 0;
};

/// 0: all cores. More threads than there are cores is honoured.
std::unique_ptr<Crew> makeTbbCrew(unsigned threads);
std::unique_ptr<Crew> makePlainCrew(unsigned threads);

/// Gives every element of [0, count) to exactly one call of `body(begin, end)`, spread over the crew. Pieces are sized
/// by time: a call that took less than 10 us lets the next one be twice as large, one that took longer half as large.
/// So groups of a few nanoseconds are not drowned in hand-outs, and where single tiles are heavy each is its own piece.
/// Measured on two cores of an EPYC: 1.1 us a dispatch (8 us with plain threads), 1.0 ns a group that does nothing
/// much. The first exception of a body stops the hand-out and is thrown again here.
void spread(Crew& crew, std::uint32_t count, const std::function<void(std::uint32_t, std::uint32_t)>& body);

}  // namespace tessera::devices::cpu
