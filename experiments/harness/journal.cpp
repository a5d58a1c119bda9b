#include "experiments/harness/journal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>

#include "datasets/text.h"
#include "experiments/harness/fields.h"
#include "host/error.h"
#include "host/files.h"
#include "host/row.h"

namespace tessera::harness {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds kSyncInterval{5};  // what a crash of the machine, not of the program, may cost
constexpr int kOldestRowSchema = 2;  // version 3 has null where that had a 0 for what an image does not hold
constexpr std::array kStatuses{"ok", "overflow", "unsupported", "timeout", "error"};

/// Numbers, or null where there was nothing to count.
void checkNumbers(const Json& json, const char* key) {
  if (!json.contains(key)) return;
  for (const auto& [name, value] : objectAt(json, key).items())
    if (!value.is_null() && !(value.is_number() && std::isfinite(value.get<double>())))
      failField(fmt::format("{}.{}", key, name), &value, "a number or null");
}

/// A row as a check leaves it, with all that rows, summaries and a resumed sweep take from it.
void checkRow(const Json& row, int version) {
  if (wholeAt<unsigned>(row, "schema_version") != static_cast<unsigned>(version))
    failField("schema_version", &member(row, "schema_version"), fmt::format("that of the journal, {},", version));
  const std::string& status = textAt(row, "status");
  if (std::ranges::find(kStatuses, status) == std::end(kStatuses))
    failField("status", &member(row, "status"), fmt::format("one of {}", fmt::join(kStatuses, ", ")));
  textAt(row, "run_id");
  for (const auto& [axis, value] : objectAt(row, "variant").items()) textAt(objectAt(row, "variant"), axis.c_str());
  objectAt(row, "provenance");
  objectAt(row, "scene");
  for (const char* const key : {"message", "clock", "picture"})
    if (row.contains(key)) textAt(row, key);
  for (const char* const key : {"error", "truth_error", "counters"}) checkNumbers(row, key);
  if (row.contains("kernel_files"))
    for (const auto& [stage, file] : objectAt(row, "kernel_files").items()) textAt(file, "sha256");
}

void checkCell(const Json& cell) {
  textAt(cell, "name");
  textAt(cell, "command");
  const Json& sweep = objectAt(cell, "sweep");
  wholeAt<std::uint32_t>(sweep, "group");
  for (const char* const key : {"reference", "twin"}) flagAt(sweep, key);
  for (const char* const key : {"title", "question", "sha256", "scene", "device"}) textAt(sweep, key);
  if (member(sweep, "cell") != member(cell, "cell"))
    failField("sweep.cell", &member(sweep, "cell"), "the cell's number");
  for (const auto& [axis, value] : objectAt(sweep, "asked").items()) textAt(objectAt(sweep, "asked"), axis.c_str());
  for (const Json& axis : listAt(sweep, "swept"))
    if (!axis.is_string()) failField("sweep.swept", &axis, "names");
}

Sample sampleOf(const Json& head, const Json& line) {
  Sample sample{.round = static_cast<unsigned>(wholeAt(line, "round", head.at("rounds").get<unsigned>() - 1)),
                .repeat = static_cast<unsigned>(wholeAt(line, "repeat", head.at("repeats").get<unsigned>() - 1)),
                .session = wholeAt<unsigned>(line, "session"),
                .times = {.totalNs = wholeAt<std::uint64_t>(line, "total_ns"), .stages = {}},
                .error = line.value("error", Json())};
  for (const auto& [stage, ns] : objectAt(line, "stages").items())
    sample.times.stages.emplace_back(stage, wholeAt<std::uint64_t>(objectAt(line, "stages"), stage.c_str()));
  if (!sample.error.is_null()) checkNumbers(line, "error");
  return sample;
}

void take(Record& record, const Json& line) {
  const std::string& kind = textAt(line, "kind");
  if (kind == "session") {
    record.sessions = wholeAt<std::uint16_t>(line, "session") + 1u;
    return;
  }
  if (kind != "cell" && kind != "end" && kind != "sample")
    failField("kind", &member(line, "kind"), "session, cell, end or sample");
  const auto found = record.cells.find(wholeAt<std::uint32_t>(line, "cell"));
  if (found == record.cells.end()) failField("cell", &member(line, "cell"), "one of the head's cells");
  CellRecord& cell = found->second;
  if (kind == "cell") {
    if (!cell.row.is_null()) failField("cell", &member(line, "cell"), "one that was not checked before");
    const Json& row = objectAt(line, "row");
    checkRow(row, record.head.at("schema_version").get<int>());
    cell.frameS = finiteAt(line, "frame_s");
    cell.row = row;
    return;
  }
  if (cell.row.is_null()) failField("cell", &member(line, "cell"), "one that a line before has checked");
  if (kind == "end") {
    cell.row["status"] = textAt(line, "status");
    cell.row["message"] = textAt(line, "message");
    checkRow(cell.row, record.head.at("schema_version").get<int>());
  } else {
    const bool again = line.contains("again") && flagAt(line, "again");
    (again ? cell.again : cell.samples).push_back(sampleOf(record.head, line));
  }
}

void takeHead(Record& record, const fs::path& path, const Json& line) {
  if (textAt(line, "kind") != "head") failField("kind", &member(line, "kind"), "head");
  const auto version = wholeAt<std::uint16_t>(line, "schema_version");
  if (version < kOldestRowSchema || version > kRowSchemaVersion)
    failUsage(
        fmt::format("{}:1: rows of version {}, this program's have {}; the program that began it goes on with it, or a "
                    "new folder begins anew",
                    path.string(), version, kRowSchemaVersion));
  const Json& sweep = objectAt(line, "sweep");
  for (const char* const key : {"title", "question", "sha256"}) textAt(sweep, key);
  flagAt(line, "quick");
  for (const char* const key : {"rounds", "repeats"})
    if (wholeAt<std::uint16_t>(line, key) == 0) failField(key, &member(line, key), "a number from 1 on");
  for (const Json& job : listAt(line, "jobs"))
    if (!job.is_string()) failField("jobs", &job, "names");
  for (const Json& cell : listAt(line, "cells")) {
    const auto number = wholeAt<std::uint32_t>(cell, "cell");
    if (record.cells.contains(number)) failField("cells", &member(cell, "cell"), "another number for each cell");
    checkCell(cell);
    record.cells[number];
  }
  record.head = line;
}

}  // namespace

fs::path journalOf(const fs::path& folder) { return folder / "journal.jsonl"; }

Record readJournal(const fs::path& folder) {
  const fs::path path = journalOf(folder);
  if (!fs::is_regular_file(path))
    failUsage(fmt::format("{}: is no file; a sweep's journal would be right", path.string()));
  const std::string text = readFile(path);
  Record record;
  std::size_t number = 1;
  for (std::size_t begin = 0, end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1, ++number) {
    try {
      const Json line = parsedLine(std::string_view(text).substr(begin, end - begin));
      if (number == 1)
        takeHead(record, path, line);
      else
        take(record, line);
    } catch (const WrongField& wrong) {
      failUsage(fmt::format("{}:{}: no line of a sweep's journal: {}", path.string(), number, wrong.what()));
    }
    record.bytes = end + 1;
  }
  if (record.bytes == 0)
    failUsage(fmt::format("{}:1: no line of a sweep's journal; another folder would do", path.string()));
  return record;
}

void Journal::create(const fs::path& folder, const Json& head) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) failUsage(fmt::format("{}: the folder cannot be made: {}", folder.string(), error.message()));
  try {
    // A sweep that was begun here in the meantime keeps its journal.
    if (writeNew(journalOf(folder), lineOf(head))) return;
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
