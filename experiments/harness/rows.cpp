#include "experiments/harness/rows.h"

#include <fmt/format.h>
#include <tessera/error.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <tuple>

#include "experiments/harness/fields.h"
#include "host/measure/row.h"
#include "host/support/files.h"

namespace tessera::harness {
namespace {

std::vector<Sample> inOrder(std::vector<Sample> samples) {
  std::ranges::sort(samples, {}, [](const Sample& s) { return std::tuple(s.round, s.repeat, s.session); });
  return samples;
}

Json samplesJson(const std::vector<Sample>& samples) {
  Json json{{"samples", Json::array()}, {"rounds", Json::array()}, {"sessions", Json::array()}};
  for (const Sample& sample : samples) {
    json["samples"].push_back(sample.times.totalNs);
    json["rounds"].push_back(sample.round);
    json["sessions"].push_back(sample.session);
  }
  return json;
}

Json timeJson(const PointRecord& cell, const std::vector<Sample>& samples, const std::string& clock) {
  std::vector<FrameTimes> times;
  for (const Sample& sample : samples) times.push_back(sample.times);
  const measure::Spread total = measure::totalSpread(times);
  Json json = samplesJson(samples);
  json["median"] = total.median;
  json["min"] = total.min;
  json["iqr"] = total.iqr;
  json["stages"] = Json::object();
  for (const auto& [stage, median] : measure::stageMedians(times)) json["stages"][stage] = median;
  json["clock"] = clock;
  if (!cell.again.empty()) json["again"] = samplesJson(inOrder(cell.again));
  return json;
}

/// Of variants that differ from run to run: lists of what each timed frame was in error by, and their medians in
/// `error`.
void putErrors(Json& row, const std::vector<Sample>& samples) {
  Json lists = Json::object();
  std::vector<std::string> fields;
  for (const Sample& sample : samples)
    if (sample.error.is_object())
      for (const auto& [field, value] : sample.error.items())
        if (field != "pixels" && std::ranges::find(fields, field) == fields.end()) fields.push_back(field);
  for (const auto& field : fields) {
    std::vector<double> values;
    for (const Sample& sample : samples) {
      lists[field].push_back(sample.error.is_object() ? sample.error.value(field, Json()) : Json());
      if (lists[field].back().is_number()) values.push_back(lists[field].back());
    }
    if (values.empty()) {  // what no frame holds
      lists.erase(field);
      continue;
    }
    const double median = medianOf(values);
    if (const auto whole = static_cast<std::int64_t>(median); static_cast<double>(whole) == median)
      row["error"][field] = whole;
    else
      row["error"][field] = median;
  }
  if (!lists.empty()) row["error_samples"] = lists;
}

Json rowOf(const Json& head, const PointRecord& cell) {
  const std::vector<Sample> samples = inOrder(cell.samples);
  Json checked = cell.row;
  putErrors(checked, samples);
  Json row = Json::object();
  for (const auto& [field, value] : checked.items()) {
    if (field == "provenance" || field == "clock") continue;
    row[field] = value;
    if (field != "run_id") continue;
    row["command"] = head.at("command");
    row["sweep"] = head.at("sweep");
  }
  if (!samples.empty()) row["time_ns"] = timeJson(cell, samples, checked.value("clock", ""));
  row["provenance"] = checked.at("provenance");
  return row;
}

}  // namespace

double medianOf(std::vector<double> values) {
  if (values.empty()) return 0;
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

std::string rowsText(const Record& record) {
  std::string text;
  for (const auto& head : record.head.at("cells"))
    if (const PointRecord& cell = record.cells.at(head.at("cell")); !cell.row.is_null())
      text += lineOf(rowOf(head, cell));
  return text;
}

void checkRowsKept(const std::filesystem::path& folder, const Record& record) {
  const std::filesystem::path path = folder / "rows.jsonl";
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return;
  if (!std::filesystem::is_regular_file(path, error))
    failUsage(fmt::format("{}: is no file; the rows of a sweep would be right", path.string()));
  std::map<std::string, std::size_t> samples;  // by run
  for (const auto& [number, cell] : record.cells)
    if (!cell.row.is_null()) samples[textAt(cell.row, "run_id")] = cell.samples.size();
  std::ifstream file(path);
  std::size_t number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    try {
      const Json row = parsedLine(line);
      const auto found = samples.find(textAt(row, "run_id"));
      const std::size_t had = row.contains("time_ns") ? listAt(objectAt(row, "time_ns"), "samples").size() : 0;
      if (found != samples.end() && had <= found->second) continue;
      failUsage(
          fmt::format("{}:{}: {} the journal beside it has not; nothing was written: take the journal away to keep "
                      "these rows, or the rows to make them anew from the journal",
                      path.string(), number, found == samples.end() ? "a row that" : "samples that"));
    } catch (const WrongField&) {  // no row is lost with it
    }
  }
}

void deriveRows(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "rows.jsonl";
  const Record record = readJournal(folder);
  checkRowsKept(folder, record);
  try {
    support::writeWhole(path, rowsText(record));
  } catch (const Error& error) {
    fail(fmt::format("{}; the journal beside it is whole: --resume writes it once there is room", error.what()));
  }
}

}  // namespace tessera::harness
