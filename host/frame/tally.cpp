#include "host/frame/tally.h"

#include <algorithm>

namespace tessera::frame {

KernelCounters::KernelCounters(Dispatcher& dispatcher)
    : words_(dispatcher.read<std::uint32_t>("counters", 2 * kernelCounterCount())) {}

std::uint64_t KernelCounters::operator[](std::string_view name) const {
  const std::size_t i = counterIndex(name);
  return words_[2 * i] | std::uint64_t{words_[2 * i + 1]} << 32;
}

Tally::Tally() {
  for (const CounterDoc& doc : counterDocs()) counters[doc.name] = 0;
}

void Tally::count(std::string_view name, std::uint64_t value) { count(name, value, band_); }

void Tally::count(std::string_view name, std::uint64_t value, Counters& into) const {
  const CounterDoc& doc = counterDoc(name);
  std::uint64_t& sum = into[doc.name];
  sum = doc.merge == CounterMerge::kLargest ? std::max(sum, value) : sum + value;
}

void Tally::take(const KernelCounters& kernels, bool all) {
  for (const CounterDoc& doc : counterDocs())
    if (doc.inKernels && (all || doc.work)) count(doc.name, kernels[doc.name]);
}

void Tally::endBand(bool first) {
  for (const auto& [name, value] : band_)
    if (first || counterDoc(name).merge != CounterMerge::kOnce) count(name, value, counters);
}

void Tally::addTotal(const std::vector<StageTime>& list) {
  if (!list.empty()) times.totalNs += list.back().endNs - list.front().beginNs;
}

void Tally::addTimes(const std::vector<StageTime>& list) {
  for (const StageTime& time : list) {
    auto found = std::ranges::find(times.stages, time.stage, [](const auto& s) { return s.first; });
    if (found == times.stages.end()) found = times.stages.insert(found, {time.stage, 0});
    found->second += time.endNs - time.beginNs;
  }
}

}  // namespace tessera::frame
