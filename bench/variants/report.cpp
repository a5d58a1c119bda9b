#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bench/variants/cells.h"
#include "host/plan/stages.h"
#include "host/support/table.h"

namespace tessera::bench {
namespace {

using Json = nlohmann::ordered_json;
using Rows = std::vector<std::vector<std::string>>;

/// What explains a time: the work of raster, what bins held, and how often a stage ran again.
const std::vector<std::string> kCounters{"looks",   "visited", "tests", "covered",
                                         "atomics", "binned",  "items", "retries"};

std::string note(const Cell& cell, const Limits& limits) {
  if (!cell.plan) return "refused: " + cell.refused;
  if (cell.slow) return fmt::format("measured once: a frame takes more than {} s", limits.slowS);
  return cell.frames.size() < limits.rounds ? fmt::format("{} s were spent", limits.budgetS) : "";
}

std::string twoDigits(double number) {
  return fmt::format("{:.{}f}", number, number < 9.995 ? 2 : number < 99.95 ? 1 : 0);
}

std::vector<std::string> nameOf(const Cell& cell) { return {cell.binning, cell.traversal, cell.commit}; }

/// Stages that ran in any cell, in pipeline order.
std::vector<std::string> stagesThatRan(const SceneCells& scene) {
  std::vector<std::string> names;
  for (const Stage& stage : stages())
    if (std::ranges::any_of(scene.cells, [&](const Cell& cell) {
          return !cell.frames.empty() &&
                 std::ranges::any_of(cell.frames[0].stages, [&](const auto& s) { return s.first == stage.name; });
        }))
      names.push_back(stage.name);
  return names;
}

Json stagesJson(const std::vector<FrameTimes>& frames) {
  Json json = Json::object();
  for (const auto& [stage, ns] : stageMedians(frames)) json[stage] = ns;
  return json;
}

Json cellJson(const SceneCells& scene, const Cell& cell, const char* kind) {
  return {{"kind", kind},
          {"scene", scene.scene},
          {"binning", cell.binning},
          {"traversal", cell.traversal},
          {"commit", cell.commit}};
}

}  // namespace

std::string text(const SceneCells& scene, const Limits& limits) {
  const std::vector<std::string> stageNames = stagesThatRan(scene);
  Rows times{{"binning", "traversal", "commit", "rounds", "ms", "half IQR", "ratio", "half IQR"}};
  for (const std::string& stage : stageNames) times[0].push_back(stage);
  times[0].push_back("");
  Rows counts{{"binning", "traversal", "commit"}};
  counts[0].insert(counts[0].end(), kCounters.begin(), kCounters.end());
  for (const Cell& cell : scene.cells) {
    const bool measured = !cell.frames.empty();
    const Spread total = totalSpread(cell.frames), times1 = measured ? ratio(cell) : Spread{};
    std::vector<std::string> row = nameOf(cell);
    row.push_back(std::to_string(cell.frames.size()));
    for (const std::string& figure :
         {milliseconds(total.median), milliseconds(total.iqr / 2), twoDigits(times1.median), twoDigits(times1.iqr / 2)})
      row.push_back(measured ? figure : "-");
    const auto medians = stageMedians(cell.frames);
    for (const std::string& stage : stageNames) {
      const auto found = std::ranges::find(medians, stage, [](const auto& entry) { return entry.first; });
      row.push_back(found == medians.end() ? "-" : milliseconds(found->second));
    }
    row.push_back(note(cell, limits));
    times.push_back(row);
    if (!cell.plan) continue;
    row = nameOf(cell);
    for (const std::string& counter : kCounters) row.push_back(grouped(cell.counters.at(counter)));
    counts.push_back(row);
  }
  return fmt::format(
      "{}, {} triangles: median times in ms, of the frame and of its stages; ratio: to the default's frame beside it\n"
      "(the first row is the default beside itself: how far its ratio is from 1 is the noise)\n{}\n"
      "what one frame counted\n{}",
      scene.scene, grouped(scene.triangles), table(times), table(counts));
}

std::string jsonLines(const Report& report, bool raw) {
  Json run = {{"kind", "run"},
              {"size", {report.size, report.size}},
              {"rounds", report.limits.rounds},
              {"budget_s", report.limits.budgetS},
              {"slow_s", report.limits.slowS}};
  for (const auto& [name, value] : report.provenance) run["provenance"][name] = value;
  std::string lines = run.dump() + "\n";
  for (const SceneCells& scene : report.scenes)
    for (const Cell& cell : scene.cells) {
      Json line = cellJson(scene, cell, "cell");
      line["triangles"] = scene.triangles;
      line["asked"] = cell.asked.text();
      line["status"] = cell.plan ? "ok" : "refused";
      if (!cell.plan) line["message"] = cell.refused;
      if (!cell.frames.empty()) {
        const Spread total = totalSpread(cell.frames), times = ratio(cell);
        line["rounds"] = cell.frames.size();
        line["slow"] = cell.slow;
        line["total_ns"] = {{"median", total.median}, {"min", total.min}, {"iqr", total.iqr}};
        line["ratio"] = {{"median", times.median}, {"min", times.min}, {"iqr", times.iqr}};
        line["stages_ns"] = stagesJson(cell.frames);
      }
      for (const auto& [name, value] : cell.counters) line["counters"][name] = value;
      lines += line.dump() + "\n";
      for (std::size_t i = 0; raw && i < cell.frames.size(); ++i) {
        Json frame = cellJson(scene, cell, "frame");
        frame["round"] = cell.rounds[i];
        frame["total_ns"] = cell.frames[i].totalNs;
        frame["default_ns"] = cell.defaults[i].totalNs;
        frame["stages_ns"] = stagesJson({cell.frames[i]});
        lines += frame.dump() + "\n";
      }
    }
  return lines;
}

}  // namespace tessera::bench
