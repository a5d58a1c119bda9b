#include "experiments/harness/journal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <tessera/error.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <set>
#include <utility>

#include "datasets/text.h"
#include "experiments/harness/fields.h"
#include "experiments/harness/journal-rules.h"
#include "host/measure/row.h"
#include "host/support/files.h"

namespace tessera::harness {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds kSyncInterval{5};  // what a crash of the machine, not of the program, may cost
constexpr int kOldestRowSchema = 2;  // version 3 has null where that had a 0 for what an image does not hold

/// What has been read so far, and what of it must not be there twice.
struct Reading {
  Record record;
  JournalRules rules;
  std::map<std::size_t, const Json*> heads;  ///< the cells as the head has them
  std::set<std::string> runs;
  std::set<std::array<std::size_t, 3>> samples;  ///< cell, round, repeat
  std::set<std::array<std::size_t, 4>> again;    ///< and session
};

Sample sampleOf(const Json& head, const Json& line) {
  Sample sample{.round = static_cast<unsigned>(wholeAt(line, "round", head.at("rounds").get<unsigned>() - 1)),
                .repeat = static_cast<unsigned>(wholeAt(line, "repeat", head.at("repeats").get<unsigned>() - 1)),
                .session = wholeAt<unsigned>(line, "session"),
                .times = {.totalNs = wholeAt<std::uint64_t>(line, "total_ns"), .stages = {}},
                .error = line.value("error", Json())};
  for (const auto& [stage, ns] : line.at("stages").items())
    sample.times.stages.emplace_back(stage, wholeAt<std::uint64_t>(line.at("stages"), stage.c_str()));
  return sample;
}

/// Where a resumed session times the reference and its twin once more, it says so; else a sample is there once.
void takeSample(Reading& reading, std::size_t number, const Json& line) {
  PointRecord& cell = reading.record.cells.at(number);
  reading.rules.checkSample(line, cell.row);
  const Sample sample = sampleOf(reading.record.head, line);
  const Json& sweep = reading.heads.at(number)->at("sweep");
  const std::array<std::size_t, 3> place{number, sample.round, sample.repeat};
  if (!line.contains("again") || !flagAt(line, "again")) {
    if (!reading.samples.insert(place).second)
      failField("repeat", &member(line, "repeat"), "a sample that no line before has");
    cell.samples.push_back(sample);
    return;
  }
  const bool isBase = flagAt(sweep, "reference") || flagAt(sweep, "twin");
  if (!isBase || sample.session == 0 || !reading.samples.contains(place) ||
      !reading.again.insert({number, sample.round, sample.repeat, sample.session}).second)
    failField("again", &member(line, "again"), "a sample of a reference or its twin, once more in a later session,");
  cell.again.push_back(sample);
}

void take(Reading& reading, const Json& line) {
  Record& record = reading.record;
  const std::string& kind = textAt(line, "kind");
  if (kind == "session") {
    if (wholeAt<std::uint16_t>(line, "session") != record.sessions)
      failField("session", &member(line, "session"),
                fmt::format("{}, the number of sessions before it,", record.sessions));
    reading.rules.takeSession(line, record.head);
    ++record.sessions;
    return;
  }
  if (kind != "cell" && kind != "end" && kind != "sample")
    failField("kind", &member(line, "kind"), "session, cell, end or sample");
  if (wholeAt<std::uint16_t>(line, "session") + 1u != record.sessions)
    failField("session", &member(line, "session"), "that of the last line of a session before it");
  const auto number = wholeAt<std::uint32_t>(line, "cell");
  const auto found = record.cells.find(number);
  if (found == record.cells.end()) failField("cell", &member(line, "cell"), "one of the head's cells");
  PointRecord& cell = found->second;
  if (kind == "cell") {
    if (!cell.row.is_null()) failField("cell", &member(line, "cell"), "one that was not checked before");
    const Json& row = objectAt(line, "row");
    reading.rules.takeRow(row, *reading.heads.at(number), record.head);
    if (!reading.runs.insert(row.at("run_id")).second)
      failField("run_id", &member(row, "run_id"), "one that no line before has");
    cell.frameS = finiteAt(line, "frame_s");
    cell.row = row;
    return;
  }
  if (cell.row.is_null()) failField("cell", &member(line, "cell"), "one that a line before has checked");
  if (cell.row.at("status") != "ok") failField("cell", &member(line, "cell"), "one that has not ended");
  if (kind == "sample") return takeSample(reading, number, line);
  if (textAt(line, "status") == "ok") failField("status", &member(line, "status"), "what ended the cell");
  cell.row["status"] = textAt(line, "status");
  cell.row["message"] = textAt(line, "message");
  reading.rules.takeRow(cell.row, *reading.heads.at(number), record.head);
}

void takeHead(Reading& reading, const fs::path& path, const Json& line) {
  Record& record = reading.record;
  if (textAt(line, "kind") != "head") failField("kind", &member(line, "kind"), "head");
  const auto version = wholeAt<std::uint16_t>(line, "schema_version");
  if (version < kOldestRowSchema || version > measure::kRowSchemaVersion)
    failUsage(
        fmt::format("{}:1: rows of version {}, this program's have {}; the program that began it goes on with it, or a "
                    "new folder begins anew",
                    path.string(), version, measure::kRowSchemaVersion));
  const Json& sweep = objectAt(line, "sweep");
  for (const char* const key : {"title", "question", "sha256"}) textAt(sweep, key);
  flagAt(line, "quick");
  for (const auto& [key, most] : {std::pair{"rounds", kMaxRounds}, {"repeats", kMaxFrames}})
    if (wholeAt(line, key, most) == 0) failField(key, &member(line, key), "a number from 1 on");
  for (const char* const key : {"jobs", "devices"})
    if (line.contains(key) || std::string_view(key) == "jobs")  // older journals do not name the devices
      for (const Json& name : listAt(line, key))
        if (!name.is_string()) failField(key, &name, "names");
  record.head = line;
  for (const Json& cell : listAt(record.head, "cells")) {
    const std::string place = fmt::format("cells.{}", reading.heads.size());
    const auto number = wholeAt<std::uint32_t>(cell, "cell");
    if (!reading.heads.emplace(number, &cell).second)
      failField(place + ".cell", &member(cell, "cell"), "another number for each cell");
    reading.rules.takeCell(cell, record.head, place);
    record.cells[number];
  }
}

}  // namespace

fs::path journalOf(const fs::path& folder) { return folder / "journal.jsonl"; }

Record readJournal(const fs::path& folder) {
  const fs::path path = journalOf(folder);
  if (!fs::is_regular_file(path))
    failUsage(fmt::format("{}: is no file; a sweep's journal would be right", path.string()));
  const std::string text = datasets::readFile(path);
  Reading reading;
  Record& record = reading.record;
  std::size_t number = 1;
  for (std::size_t begin = 0, end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1, ++number) {
    try {
      const Json line = parsedLine(std::string_view(text).substr(begin, end - begin));
      if (number == 1)
        takeHead(reading, path, line);
      else
        take(reading, line);
    } catch (const WrongField& wrong) {
      failUsage(fmt::format("{}:{}: no line of a sweep's journal: {}", path.string(), number, wrong.what()));
    }
    record.bytes = end + 1;
  }
  if (record.bytes == 0)
    failUsage(fmt::format("{}:1: no line of a sweep's journal; another folder would do", path.string()));
  return std::move(record);
}

void Journal::create(const fs::path& folder, const Json& head) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) failUsage(fmt::format("{}: the folder cannot be made: {}", folder.string(), error.message()));
  try {
    // A sweep that was begun here in the meantime keeps its journal.
    if (support::writeNew(journalOf(folder), lineOf(head))) return;
  } catch (const Error& failure) {
    fail(fmt::format("{}; a folder that can be written, with room in it, would do", failure.what()));
  }
  failUsage(fmt::format("{}: another sweep has begun there meanwhile; another folder begins anew", folder.string()));
}

Journal::Journal(const fs::path& folder) : path_(journalOf(folder)) {
  file_ = open(path_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  if (file_ < 0) fail(fmt::format("{}: cannot be opened: {}", path_.string(), std::strerror(errno)));
  if (flock(file_, LOCK_EX | LOCK_NB) != 0) {
    close(file_);
    failUsage(fmt::format("{}: another sweep is writing to it; wait for it, or take another folder", path_.string()));
  }
  struct stat about {};
  fstat(file_, &about);
  bytes_ = static_cast<std::size_t>(about.st_size);
}

Journal::~Journal() {
  fdatasync(file_);
  close(file_);
}

void Journal::cut(std::size_t bytes) {
  if (readJournal(path_.parent_path()).bytes != bytes)
    failUsage(fmt::format("{}: another sweep has written to it meanwhile; --resume once more goes on from there",
                          path_.string()));
  if (bytes == bytes_) return;
  if (ftruncate(file_, static_cast<off_t>(bytes)) != 0) failed(errno);
  bytes_ = bytes;
}

void Journal::append(const Json& line) {
  const std::string text = lineOf(line);
  const ssize_t put = write(file_, text.data(), text.size());
  if (put != static_cast<ssize_t>(text.size())) {
    const int error = put < 0 ? errno : ENOSPC;
    if (put > 0 && ftruncate(file_, static_cast<off_t>(bytes_)) != 0) failed(errno);
    failed(error);
  }
  bytes_ += text.size();
  if (const auto now = std::chrono::steady_clock::now(); now - synced_ > kSyncInterval) {
    if (fdatasync(file_) != 0) failed(errno);
    synced_ = now;
  }
}

void Journal::failed(int error) {
  fail(fmt::format("{}: could not be written: {}; what it holds is whole: --resume goes on once there is room",
                   path_.string(), std::strerror(error)));
}

}  // namespace tessera::harness
