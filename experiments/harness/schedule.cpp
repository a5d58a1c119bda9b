#include "experiments/harness/schedule.h"

#include <algorithm>
#include <numeric>

namespace tessera::harness {

Schedule::Schedule(const Sweep& sweep, const std::vector<SweepPoint>& cells, const std::vector<Job>& jobs,
                   const Record& record)
    : sweep_(sweep), cells_(cells), resumed_(record.sessions > 0) {
  for (const Job& job : jobs)
    for (const std::size_t number : job.cells) {
      State& state = states_[number];
      const PointRecord& cell = record.cells.at(number);
      if (!cell.row.is_null()) check(number, cell.row.at("status") == "ok", cell.frameS);
      for (const Sample& sample : cell.samples) state.have.emplace(sample.round, sample.repeat);
    }
}

void Schedule::check(std::size_t cell, bool ok, double frameS) {
  state(cell).checked = true;
  state(cell).runs = ok;
  state(cell).turnS = frameS * (sweep_.warmUp + sweep_.repeats);
}

std::vector<Turn> Schedule::turns(const Job& job, unsigned round) const {
  std::set<std::size_t> groups;
  const auto turnOf = [&](std::size_t number) {
    Turn turn{.cell = number, .round = round, .repeats = {}, .again = {}};
    for (unsigned repeat = 0; repeat < sweep_.repeats; ++repeat)
      (state(number).have.contains({round, repeat}) ? turn.again : turn.repeats).push_back(repeat);
    return turn;
  };
  for (const std::size_t number : job.cells)
    if (runs(number) && !turnOf(number).repeats.empty()) groups.insert(cells_[number].group);
  std::vector<Turn> turns;
  for (const std::size_t number : turnOrder(job.cells, sweep_.seed, job.name, round)) {
    const SweepPoint& cell = cells_[number];
    if (!runs(number) || !groups.contains(cell.group)) continue;
    Turn turn = turnOf(number);
    if (!resumed_ || !(cell.reference || cell.twin)) turn.again.clear();
    if (!turn.repeats.empty() || !turn.again.empty()) turns.push_back(std::move(turn));
  }
  return turns;
}

std::size_t Schedule::samplesLeft(const State& state) const {
  if (state.checked && !state.runs) return 0;
  return std::size_t{sweep_.rounds} * sweep_.repeats - state.have.size();
}

bool Schedule::isDone(const Job& job) const {
  return std::ranges::all_of(job.cells,
                             [&](std::size_t number) { return checked(number) && samplesLeft(state(number)) == 0; });
}

std::size_t Schedule::cellsChecked() const {
  return static_cast<std::size_t>(std::ranges::count_if(states_, [](const auto& s) { return s.second.checked; }));
}

std::size_t Schedule::steps() const { return states_.size() * (1 + std::size_t{sweep_.rounds} * sweep_.repeats); }

std::size_t Schedule::done() const {
  std::size_t left = states_.size() - cellsChecked();
  for (const auto& [number, state] : states_) left += samplesLeft(state);
  return steps() - left;
}

double Schedule::secondsLeft() const {
  double known = 0, sum = 0;
  for (const auto& [number, state] : states_)
    if (state.turnS > 0) known += 1, sum += state.turnS;
  const double usual = known > 0 ? sum / known : 0;
  double left = 0;
  for (const auto& [number, state] : states_)
    left += static_cast<double>(samplesLeft(state)) / sweep_.repeats * (state.turnS > 0 ? state.turnS : usual);
  return left;
}

}  // namespace tessera::harness
