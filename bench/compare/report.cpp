#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bench/compare/measure.h"
#include "host/measure/row.h"
#include "host/support/table.h"

namespace tessera::bench {
namespace {

using Json = nlohmann::ordered_json;
using Rows = std::vector<std::vector<std::string>>;

std::vector<std::uint64_t> totals(const std::vector<FrameTimes>& frames) {
  std::vector<std::uint64_t> all;
  for (const FrameTimes& frame : frames) all.push_back(frame.totalNs);
  return all;
}

/// Median and interquartile range of a[i] / b[i] over the rounds.
measure::Spread ratio(const std::vector<std::uint64_t>& a, const std::vector<std::uint64_t>& b) {
  constexpr double kScale = 1e6;  // spread() takes integers
  std::vector<std::uint64_t> scaled;
  for (std::size_t i = 0; i < a.size(); ++i)
    scaled.push_back(static_cast<std::uint64_t>(kScale * static_cast<double>(a[i]) / static_cast<double>(b[i])));
  const measure::Spread s = measure::spread(scaled);
  return {s.median / kScale, s.min / kScale, s.iqr / kScale};
}

std::string withSpread(const measure::Spread& s) {
  return support::milliseconds(s.median) + " ±" + support::milliseconds(s.iqr / 2);
}

/// How far the same thing, measured twice in each round, lies apart from itself: half the IQR of the ratio, per cent.
double noise(const Comparison& c) { return 100 * ratio(totals(c.again), totals(c.cpu)).iqr / 2; }

std::string megabytes(std::uint64_t bytes) { return fmt::format("{:.0f}", static_cast<double>(bytes) * 1e-6); }

Json spreadJson(const measure::Spread& s) { return {{"median", s.median}, {"min", s.min}, {"iqr", s.iqr}}; }

}  // namespace

std::string text(const Report& report) {
  std::string out;
  for (const auto& [name, value] : report.provenance) out += fmt::format("{}: {}\n", name, value);
  out += fmt::format("draw: {}\n\n", report.drawDevice);

  Rows times{{"scene", "triangles", "covered", "CPU device, ms", "draw, ms", "draw / CPU", "A/A", "noise %", "coverage differs", "id differs"}};
  for (const Comparison& c : report.comparisons) {
    const measure::Spread faster = ratio(c.drawDevice, totals(c.cpu));
    times.push_back(
        {c.scene, support::grouped(c.triangles), support::grouped(c.covered), withSpread(measure::totalSpread(c.cpu)),
         withSpread(measure::spread(c.drawDevice)), fmt::format("{:.2f} ±{:.2f}", faster.median, faster.iqr / 2),
         fmt::format("{:.3f}", ratio(totals(c.again), totals(c.cpu)).median), fmt::format("{:.1f}", noise(c)),
         support::grouped(c.difference.coverage), support::grouped(c.difference.id)});
  }
  out += support::table(times);
  if (!report.comparisons.empty())
    out += fmt::format("median ± half the interquartile range of {} rounds; A/A: the CPU device by itself, measured twice a round\n\n",
                       report.comparisons[0].cpu.size());

  Rows stages{{"stage of the CPU device, ms"}};
  for (const Comparison& c : report.comparisons) {
    stages[0].push_back(c.scene);
    for (const auto& [stage, ns] : measure::stageMedians(c.cpu))
      if (std::ranges::none_of(stages, [&](const auto& row) { return row[0] == stage; })) stages.push_back({stage});
  }
  for (const Comparison& c : report.comparisons) {
    const auto medians = measure::stageMedians(c.cpu);
    for (auto row = stages.begin() + 1; row != stages.end(); ++row) {
      const auto found = std::ranges::find(medians, (*row)[0], [](const auto& entry) { return entry.first; });
      row->push_back(found == medians.end() ? "-" : support::milliseconds(found->second));
    }
  }
  if (!report.comparisons.empty()) out += support::table(stages) + "\n";

  Rows memory{{"memory of one frame, MB", "peak of the process", "peak of the device's buffers"}};
  for (const Memory& m : report.memory) memory.push_back({m.scene, megabytes(m.peakResident), megabytes(m.peakBuffers)});
  return out + support::table(memory);
}

std::string json(const Report& report, bool raw) {
  Json all;
  for (const auto& [name, value] : report.provenance) all["provenance"][name] = value;
  all["provenance"]["draw"] = report.drawDevice;
  all["scenes"] = Json::array();
  for (const Comparison& c : report.comparisons) {
    Json scene = {{"scene", c.scene},
                  {"triangles", c.triangles},
                  {"size", {c.size, c.size}},
                  {"rounds", c.cpu.size()},
                  {"cpu_ns", spreadJson(measure::totalSpread(c.cpu))},
                  {"cpu_again_ns", spreadJson(measure::totalSpread(c.again))},
                  {"draw_device_ns", spreadJson(measure::spread(c.drawDevice))},
                  {"draw_wall_ns", spreadJson(measure::spread(c.drawWall))},
                  {"draw_over_cpu", spreadJson(ratio(c.drawDevice, totals(c.cpu)))},
                  {"again_over_cpu", spreadJson(ratio(totals(c.again), totals(c.cpu)))},
                  {"covered", c.covered},
                  {"coverage_mismatch", c.difference.coverage.value()},
                  {"id_mismatch", c.difference.id.value()},
                  {"depth_max_abs", c.difference.depthMaxAbs.value()}};
    for (const auto& [stage, ns] : measure::stageMedians(c.cpu)) scene["cpu_stages_ns"][stage] = ns;
    if (raw)
      scene["samples_ns"] = {{"cpu", totals(c.cpu)}, {"cpu_again", totals(c.again)}, {"draw_device", c.drawDevice}, {"draw_wall", c.drawWall}};
    all["scenes"].push_back(scene);
  }
  for (const Memory& m : report.memory)
    all["memory"].push_back({{"scene", m.scene}, {"peak_resident_bytes", m.peakResident}, {"peak_buffer_bytes", m.peakBuffers}});
  return all.dump(2) + "\n";
}

}  // namespace tessera::bench
