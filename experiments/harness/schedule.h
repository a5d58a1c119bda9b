// What a sweep has left to do, and how long that takes.
#pragma once

#include <set>
#include <vector>

#include "experiments/harness/cells.h"
#include "experiments/harness/journal.h"

namespace tessera::harness {

/// One cell's turn in a round: the repeats to be timed, and which of them it had already.
struct Turn {
  std::size_t cell = 0;
  unsigned round = 0;
  std::vector<unsigned> repeats;  ///< by number, those that it has not
  std::vector<unsigned> again;    ///< likewise, those that it has
};

class Schedule {
 public:
  Schedule(const Sweep& sweep, const std::vector<SweepPoint>& cells, const std::vector<Job>& jobs,
           const Record& record);

  bool checked(std::size_t cell) const { return state(cell).checked; }
  bool runs(std::size_t cell) const { return state(cell).runs; }  ///< checked, and not ended
  void check(std::size_t cell, bool ok, double frameS);
  void end(std::size_t cell) { state(cell).runs = false; }
  void sample(std::size_t cell, unsigned round, unsigned repeat) { state(cell).have.emplace(round, repeat); }
  void took(std::size_t cell, double turnS) { state(cell).turnS = turnS; }  ///< a whole turn, seconds

  /// The turns of a round in their order. In a resumed session the reference and its twin have one wherever a cell of
  /// their group has.
  std::vector<Turn> turns(const Job& job, unsigned round) const;
  bool isDone(const Job& job) const;  ///< every cell checked, and sampled or ended

  std::size_t cellsChecked() const;
  std::size_t steps() const;   ///< checks and samples of all cells
  std::size_t done() const;    ///< of these; those of a cell that has ended are
  double secondsLeft() const;  ///< by the cells' own times; of a cell that has none yet, by what the others take

 private:
  struct State {
    std::size_t cell = 0;
    bool checked = false, runs = false;
    std::set<std::pair<unsigned, unsigned>> have;  ///< round, repeat
    double turnS = 0;
  };
  State& state(std::size_t cell) { return states_.at(cell); }
  const State& state(std::size_t cell) const { return states_.at(cell); }
  std::size_t samplesLeft(const State& state) const;

  const Sweep& sweep_;
  const std::vector<SweepPoint>& cells_;
  const bool resumed_;
  std::map<std::size_t, State> states_;
};

}  // namespace tessera::harness
