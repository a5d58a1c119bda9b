#include "host/cli/parity-report.h"

#include <fmt/format.h>

#include <algorithm>

#include "host/measure/measure.h"
#include "host/measure/probe-text.h"
#include "host/support/table.h"

namespace tessera::cli {
namespace {

using Rows = std::vector<std::vector<std::string>>;

const char* verdictText(Outcome::Verdict verdict) {
  constexpr const char* kTexts[] = {"equal", "equal, not claimed", "DIFFERENT", "could not run"};
  return kTexts[verdict];
}

std::string verdictTable(const std::vector<Outcome>& outcomes) {
  Rows rows{{"device", "route", "name", "probe", "covered", "coverage", "ids", "depths", "hits", "values", "colours",
             "verdict"}};
  for (const auto& outcome : outcomes) {
    const bool compared = outcome.run.difference.has_value();
    const Difference difference = outcome.run.difference.value_or(Difference{});
    const std::string probe = outcome.probe.results.empty() ? "not run" : measure::verdictOf(outcome.probe);
    rows.push_back({outcome.attempt.device, outcome.attempt.route, outcome.run.device.name, probe,
                    compared ? support::grouped(outcome.covered) : "-", support::grouped(difference.coverage),
                    support::grouped(difference.id), support::grouped(difference.depth),
                    support::grouped(difference.hits), support::grouped(difference.attribute),
                    support::grouped(difference.colour), verdictText(outcome.verdict())});
  }
  return support::table(rows);
}

/// Stages down, devices across.
std::string timesTable(const std::vector<Outcome>& outcomes) {
  Rows rows{{"ms"}};
  for (const auto& outcome : outcomes)
    for (const auto& [stage, median] : measure::stageMedians(outcome.run.samples))
      if (std::none_of(rows.begin() + 1, rows.end(), [&](const auto& row) { return row[0] == stage; }))
        rows.push_back({stage});
  for (const auto& outcome : outcomes) {
    rows[0].push_back(outcome.attempt.name());
    const auto medians = measure::stageMedians(outcome.run.samples);
    for (auto row = rows.begin() + 1; row != rows.end(); ++row) {
      const auto found =
          std::find_if(medians.begin(), medians.end(), [&](const auto& entry) { return entry.first == row->front(); });
      row->push_back(found == medians.end() ? "-" : support::milliseconds(found->second));
    }
  }
  rows.push_back({measure::frameLabel(outcomes.front().run)});
  for (const auto& outcome : outcomes)
    rows.back().push_back(
        outcome.run.samples.empty() ? "-" : support::milliseconds(measure::totalSpread(outcome.run.samples).median));
  return support::table(rows);
}

std::string notes(const std::vector<Outcome>& outcomes) {
  std::string text, software;
  for (const auto& outcome : outcomes) {
    if (!outcome.note.empty()) text += fmt::format("{}: {}\n", outcome.attempt.name(), outcome.note);
    if (outcome.probe.onlyFlushes())
      text += fmt::format(
          "{}: denormals (floats below 1.2e-38) are flushed to zero; parity is claimed for scenes whose arithmetic "
          "meets none\n",
          outcome.attempt.name());
    else if (!outcome.probe.passed())
      text += fmt::format("{}: parity is not claimed, its arithmetic differs: {}\n", outcome.attempt.name(),
                          measure::firstFailure(outcome.probe));
    if (outcome.run.device.correctnessOnly && outcome.attempt.device != software) {
      software = outcome.attempt.device;
      text += fmt::format("{}: a software driver; its times say nothing about a GPU\n", software);
    }
  }
  return text;
}

}  // namespace

std::string parityReport(const Scene& scene, const std::vector<Outcome>& outcomes) {
  const auto count = [&](Outcome::Verdict verdict) {
    return static_cast<std::size_t>(std::count_if(outcomes.begin(), outcomes.end(),
                                                  [=](const auto& outcome) { return outcome.verdict() == verdict; }));
  };
  const std::size_t equal = count(Outcome::kEqual);
  const char* const overall = count(Outcome::kDifferent) != 0 ? "DIFFERENT"
                              : equal == outcomes.size()      ? "equal"
                                                              : "not shown for all";
  const bool approximate = std::ranges::any_of(outcomes, [](const auto& o) { return o.fromFirst.has_value(); });
  const char* const to = approximate ? "first device (the variant is approximate)" : "oracle";
  return fmt::format(
      "{}: {} triangles, {} x {}; pixels that differ from the oracle:\n\n{}\n{}\n{}parity: {}; {} of {} equal to the "
      "{} "
      "in every bit\n",
      scene.name, support::grouped(scene.triangles.size()), scene.width, scene.height, verdictTable(outcomes),
      timesTable(outcomes), notes(outcomes), overall, equal, outcomes.size(), to);
}

}  // namespace tessera::cli
