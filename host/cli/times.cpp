#include "host/cli/times.h"

#include <fmt/format.h>

#include <vector>

#include "host/measure/measure.h"
#include "host/support/table.h"

namespace tessera::cli {

std::string timesText(const measure::Run& run) {
  const measure::Spread frames = measure::totalSpread(run.samples);
  std::vector<std::vector<std::string>> rows{{"stage", "ms"}};
  for (const auto& [stage, median] : measure::stageMedians(run.samples))
    rows.push_back({stage, support::milliseconds(median)});
  rows.push_back({measure::frameLabel(run), support::milliseconds(frames.median)});
  std::string text = support::table(rows);
  if (frames.count == 1) return text + "times of one frame; --repeat 20 would show how far frames are apart\n";
  return text + fmt::format("medians of {} frames; {} took {} to {} ms, its median is {} +- {} ms\n", frames.count,
                            measure::frameLabel(run), support::milliseconds(frames.min),
                            support::milliseconds(frames.max), support::milliseconds(frames.median),
                            support::milliseconds(frames.median * frames.medianError()));
}

std::string timesWarning(const measure::Run& run) {
  const measure::Spread frames = measure::totalSpread(run.samples);
  if (frames.medianError() <= kWideSpread) return "";
  return fmt::format(
      "warning: the frames took {} to {} ms: their median may be off by {:.0f} %; a quieter machine would help, or "
      "more "
      "than --repeat {}\n",
      support::milliseconds(frames.min), support::milliseconds(frames.max), 100 * frames.medianError(), frames.count);
}

}  // namespace tessera::cli
