// tessera expand: a sweep's cells, what the planner refuses among them, and how long they will take.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "experiments/harness/cells.h"
#include "experiments/harness/estimate.h"
#include "experiments/harness/survey.h"
#include "experiments/harness/sweep-file.h"
#include "host/cli/commands.h"
#include "host/cli/common.h"
#include "host/devices/open.h"
#include "host/support/table.h"
#include "host/support/terminal.h"

namespace tessera::cli {
namespace {

using namespace tessera::harness;

struct ExpandOptions {
  std::string sweep;
  bool quick = false, json = false, noEstimate = false, allowKernels = false, quiet = false;
  Changes changes;
};

std::string expandJson(const Sweep& sweep, const std::vector<SweepPoint>& cells, const Survey& survey,
                       const std::optional<Estimate>& estimate) {
  nlohmann::ordered_json json{{"title", sweep.title}, {"sha256", sweep.sha256}, {"seed", sweep.seed}};
  json["jobs"] = nlohmann::ordered_json::array();
  std::vector<std::string> jobOf(cells.size());
  for (const Job& job : jobs(sweep, cells)) {
    json["jobs"].push_back(
        {{"name", job.name}, {"scene", sweep.scenes[job.scene].name}, {"device", job.device}, {"cells", job.cells}});
    for (const std::size_t number : job.cells) jobOf[number] = job.name;
  }
  json["cells"] = nlohmann::ordered_json::array();
  for (const SweepPoint& cell : cells) {
    const auto& refused = survey.cells[cell.number].refused;
    json["cells"].push_back({{"cell", cell.number},
                             {"job", jobOf[cell.number]},
                             {"group", cell.group},
                             {"asked", cell.labels},
                             {"size", {cell.size.width, cell.size.height}},
                             {"device", cell.device},
                             {"threads", cell.threads},
                             {"reference", cell.reference},
                             {"twin", cell.twin},
                             {"refused", refused ? nlohmann::ordered_json(*refused) : nlohmann::ordered_json()}});
  }
  json["estimate_s"] = estimate && !estimate->nothing ? nlohmann::ordered_json(std::round(10 * estimate->seconds) / 10)
                                                      : nlohmann::ordered_json();
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n';
}

/// A line a job.
std::string jobsTable(const Sweep& sweep, const std::vector<SweepPoint>& cells, const Survey& survey) {
  std::vector<std::vector<std::string>> rows{{"job", "sizes", "threads", "cells", "refused"}};
  for (const Job& job : jobs(sweep, cells)) {
    std::set<std::string> threads;
    std::size_t refused = 0;
    for (const std::size_t number : job.cells) {
      const unsigned count = cells[number].threads;
      threads.insert(!devices::takesThreads(job.device) ? "-" : count == 0 ? "all" : std::to_string(count));
      refused += survey.cells[number].refused.has_value();
    }
    std::vector<std::string> sizes;
    for (const Size size : sweep.sizes) sizes.push_back(fmt::format("{}x{}", size.width, size.height));
    rows.push_back({job.name, fmt::format("{}", fmt::join(sizes, " ")), fmt::format("{}", fmt::join(threads, " ")),
                    std::to_string(job.cells.size()), std::to_string(refused)});
  }
  return support::table(rows);
}

std::size_t referenceOf(const std::vector<SweepPoint>& cells, std::size_t group) {
  return std::ranges::find_if(cells, [=](const SweepPoint& c) { return c.group == group && c.reference; })->number;
}

/// What a variant is to the groups that it stands for.
std::string referenceWords(std::size_t references, std::size_t refused, std::size_t groups) {
  if (references == 0) return "";
  std::string text =
      references == groups ? "  (reference" : fmt::format("  (reference of {} of {} groups", references, groups);
  if (refused == references) return text + ", but refused: no ratios)";
  if (refused != 0) text += fmt::format(", refused in {}: no ratios there", refused);
  return text + ", each twice)";
}

/// A line a variant, and one more for each reason that some of its cells are refused for. Those of scenes, devices,
/// sizes and threads are counted together.
std::string variantsTable(const Sweep& sweep, const std::vector<SweepPoint>& cells, const Survey& survey) {
  struct Variants {
    std::size_t cells = 0;
    std::size_t references = 0, refusedReferences = 0;
    std::vector<std::pair<std::string, std::size_t>> reasons;
  };
  std::vector<std::pair<std::string, Variants>> variants;
  std::map<std::string, std::size_t> places;
  for (const SweepPoint& cell : cells) {
    const std::string name = variantName(sweep, cell);
    const auto [place, isNew] = places.try_emplace(name, variants.size());
    if (isNew) variants.emplace_back(name, Variants{});
    Variants& variant = variants[place->second].second;
    ++variant.cells;
    const auto& refused = survey.cells[cell.number].refused;
    variant.references += cell.reference;
    variant.refusedReferences += cell.reference && refused;
    if (!refused) continue;
    auto reason = std::ranges::find(variant.reasons, *refused, &std::pair<std::string, std::size_t>::first);
    if (reason == variant.reasons.end()) reason = variant.reasons.insert(reason, {*refused, 0});
    ++reason->second;
  }
  std::vector<std::vector<std::string>> rows{{"cells", "variant", "refused, and why"}};
  for (const auto& [name, variant] : variants) {
    const std::string text = (name.empty() ? "as set" : name) +
                             referenceWords(variant.references, variant.refusedReferences, cells.back().group + 1);
    rows.push_back({std::to_string(variant.cells), text, ""});
    bool first = true;
    for (const auto& [reason, count] : variant.reasons) {
      if (!first) rows.push_back({"", "", ""});
      first = false;
      rows.back()[2] = fmt::format("{}: {}", count == variant.cells ? "all" : std::to_string(count), reason);
    }
  }
  return support::table(rows);
}

/// "40 s", "12 min", "3.5 h".
std::string duration(double seconds) {
  if (seconds < 90) return fmt::format("{:.0f} s", std::max(1.0, seconds));
  return seconds < 5400 ? fmt::format("{:.0f} min", seconds / 60) : fmt::format("{:.1f} h", seconds / 3600);
}

std::string estimateText(const Estimate& estimate) {
  const std::string missing = estimate.unmeasured == 0
                                  ? ""
                                  : fmt::format("{} cells are not counted, since their reference failed: {}\n",
                                                support::grouped(estimate.unmeasured), estimate.whyNot);
  if (estimate.nothing) return missing.empty() ? "none of it runs here\n" : missing;
  std::string text = fmt::format("about {} here, by the references' times, measured now", duration(estimate.seconds));
  if (estimate.others != 0 && estimate.fromRows == 0)
    text += ", if every other cell takes as long: no results.jsonl beside the sweep has ratios";
  if (estimate.fromRows != 0)
    text += fmt::format(", and the ratios of {} of {} other cells in results.jsonl{}",
                        support::grouped(estimate.fromRows), support::grouped(estimate.others),
                        estimate.fromRows < estimate.others ? "; the rest count as their references" : "");
  if (!estimate.compilingIsCounted)
    text += fmt::format("; compiling ({}) comes on top", support::grouped(estimate.uncompiled));
  return text + '\n' + missing;
}

ExitCode expand(const ExpandOptions& options) {
  const Sweep sweep = readSweep(options.sweep, options.quick, options.changes);
  std::vector<SweepPoint> all = cells(sweep);
  KernelCache kernels;
  Survey surveyed = survey(sweep, all, kernels);
  if (chooseReferences(sweep, all, [&](std::size_t number) { return surveyed.cells[number].refused.has_value(); }))
    for (const SweepPoint& cell : all)
      if (cell.twin) surveyed.cells[cell.number] = surveyed.cells[referenceOf(all, cell.group)];
  if (!options.json) {
    std::size_t refused = 0;
    for (const SurveyedPoint& cell : surveyed.cells) refused += cell.refused.has_value();
    support::say(stdout, "{}\n{}\n\n{}\n{}\n", sweep.title, sweep.question, jobsTable(sweep, all, surveyed),
                 variantsTable(sweep, all, surveyed));
    support::say(stdout,
                 "{} cells, {} of them refused; {} rounds, each of {} + {} frames a cell; {} kernels, {} of them to be "
                 "compiled\n",
                 support::grouped(all.size()), support::grouped(refused), sweep.rounds, sweep.warmUp, sweep.repeats,
                 support::grouped(surveyed.kernels), support::grouped(surveyed.uncompiled.size()));
    support::flushStdout();
  }
  std::optional<Estimate> time;
  const bool kernelsMayRun = options.allowKernels || sweep.foreignKernel.empty();
  if (!options.noEstimate && !kernelsMayRun)
    support::say(stderr, "nothing was rendered to say how long it will take: {}\n", sweep.foreignKernel);
  if (!options.noEstimate && kernelsMayRun) time = estimate(sweep, all, surveyed);
  if (options.json)
    support::say(stdout, "{}", expandJson(sweep, all, surveyed, time));
  else if (time)
    support::say(stdout, "{}", estimateText(*time));
  return ExitCode::kDone;
}

}  // namespace

Command addExpand(CLI::App& app) {
  auto options = std::make_shared<ExpandOptions>();
  auto* const command =
      app.add_subcommand("expand", "list the cells of SWEEP, what is refused among them, and how long they will take");
  command->add_option("SWEEP", options->sweep, "a sweep file (.toml): experiments/README.md has its keys")->required();
  command->add_flag("--quick", options->quick, "with the sizes, rounds and scenes of its [quick]");
  addChanges(*command, options->changes);
  command->add_flag("--no-estimate", options->noEstimate, "render nothing: do not say how long it will take");
  command->add_flag("--allow-kernels", options->allowKernels,
                    "render with files of [kernels] that lie outside the sweep's folder, too: a kernel is native code");
  command->add_flag("--json", options->json, "print JSON");
  addQuiet(*command, options->quiet);
  command->footer("Example:\n  tessera expand experiments/tile-size/sweep.toml");
  return {command, [options] { return expand(*options); }};
}

}  // namespace tessera::cli
