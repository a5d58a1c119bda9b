#include "experiments/harness/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "experiments/harness/fields.h"
#include "experiments/harness/rows.h"
#include "host/measure/row.h"
#include "host/support/table.h"

namespace tessera::harness {
namespace {

constexpr std::size_t kMostLines = 40;

struct Line {
  const Json* head;
  const PointRecord* cell;
  std::string status() const { return cell->row.is_null() ? "not run" : textAt(cell->row, "status"); }
};

double medianTime(const PointRecord& cell) {
  std::vector<FrameTimes> times;
  for (const Sample& sample : cell.samples) times.push_back(sample.times);
  return measure::totalSpread(times).median;
}

/// Session and round -> median time of the turn, those that were taken again among them.
std::map<std::pair<unsigned, unsigned>, double> turnsOf(const PointRecord& cell) {
  std::map<std::pair<unsigned, unsigned>, std::vector<double>> times;
  for (const auto* samples : {&cell.samples, &cell.again})
    for (const Sample& s : *samples) times[{s.session, s.round}].push_back(static_cast<double>(s.times.totalNs));
  std::map<std::pair<unsigned, unsigned>, double> medians;
  for (auto& [turn, values] : times) medians[turn] = medianOf(std::move(values));
  return medians;
}

/// As the report has it: median over the rounds of time over the reference's in the same session and round.
std::optional<double> ratio(const PointRecord& cell, const PointRecord& reference) {
  const auto base = turnsOf(reference);
  std::vector<double> ratios;
  for (const auto& [turn, time] : turnsOf(cell))
    if (const auto found = base.find(turn); found != base.end() && found->second > 0)
      ratios.push_back(time / found->second);
  if (ratios.empty()) return {};
  return medianOf(std::move(ratios));
}

/// From the picture that is held to be true where there is one, as the page counts it.
std::string errorText(const Json& row) {
  const Json error = row.value(row.contains("truth") ? "truth_error" : "error", Json());
  if (!error.is_object()) return "-";
  std::string text;
  for (const auto& [field, name] : {std::pair{"coverage_mismatch", "coverage"},
                                    {"id_mismatch", "ids"},
                                    {"depth_mismatch", "depth"},
                                    {"hit_count_mismatch", "hits"},
                                    {"attribute_mismatch", "values"},
                                    {"colour_mismatch", "colours"}})
    if (const Json count = error.value(field, Json()); count.is_number() && count > 0)
      text += fmt::format("{}{} {:g}", text.empty() ? "" : ", ", name, count.get<double>());
  return text.empty() ? "none" : text;
}

/// Of the first cell, without what is swept.
std::string groupName(const Line& first) {
  const std::string name = first.head->at("name");
  return name.substr(0, name.find(", "));
}

std::string groupTable(const std::vector<Line>& lines, const std::vector<std::string>& swept) {
  const auto reference =
      std::ranges::find_if(lines, [](const Line& l) { return l.head->at("sweep").at("reference").get<bool>(); });
  std::vector<std::vector<std::string>> rows{swept};
  const bool truth = std::ranges::any_of(lines, [](const Line& l) { return l.cell->row.contains("truth"); });
  for (const char* const heading : {"ms", "ratio", truth ? "error from truth" : "error"}) rows[0].push_back(heading);
  for (const Line& line : lines) {
    const Json& sweep = line.head->at("sweep");
    std::vector<std::string> row;
    for (const auto& axis : swept) row.push_back(objectAt(sweep, "asked").value(axis, "-"));
    if (line.cell->samples.empty()) {
      row.insert(row.end(), {"-", "-", line.status()});
    } else {
      const bool twin = flagAt(sweep, "twin");
      row.push_back(support::milliseconds(medianTime(*line.cell)));
      const auto over = reference == lines.end() ? std::nullopt : ratio(*line.cell, *reference->cell);
      row.push_back(over ? fmt::format("{:.3f}", *over) : "-");
      row.push_back(twin ? "A/A" : errorText(line.cell->row));
    }
    rows.push_back(std::move(row));
  }
  return support::table(rows);
}

}  // namespace

std::string summaryOf(const Record& record, const std::filesystem::path& folder) {
  std::map<std::string, std::size_t> counts;
  std::map<std::size_t, std::vector<Line>> groups;
  std::string notes;
  for (const auto& head : record.head.at("cells")) {
    const Line line{&head, &record.cells.at(head.at("cell"))};
    ++counts[line.status()];
    groups[head.at("sweep").at("group")].push_back(line);
    if (const std::string message = line.cell->row.is_null() ? "" : line.cell->row.value("message", "");
        !message.empty())
      notes += fmt::format("{} ({}): {}: {}\n", head.at("cell").get<std::size_t>(), head.at("name").get<std::string>(),
                           line.status(), message);
  }
  std::string text = fmt::format("{}: {} cells", record.head.at("sweep").at("title").get<std::string>(),
                                 support::grouped(record.head.at("cells").size()));
  for (const auto& [status, count] : counts) text += fmt::format(", {} {}", count, status);
  text += '\n' + notes;

  const std::size_t tableLines = record.head.at("cells").size() + 4 * groups.size();
  if (tableLines <= kMostLines)
    for (const auto& [number, lines] : groups) {
      const Json& sweep = lines.front().head->at("sweep");
      std::vector<std::string> swept;
      for (const auto& axis : sweep.at("swept")) swept.push_back(axis);
      text += fmt::format("\n{}\n{}", groupName(lines.front()), groupTable(lines, swept));
    }
  return text + fmt::format("\nrows are in {}; tessera report {} makes the page\n", (folder / "rows.jsonl").string(),
                            folder.string());
}

}  // namespace tessera::harness
