#include "experiments/harness/journal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "datasets/text.h"
#include "host/error.h"
#include "host/files.h"
#include "host/row.h"

namespace tessera::harness {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds kSyncInterval{5};  // what a crash of the machine, not of the program, may cost

Sample sampleOf(const Json& line) {
  Sample sample{.round = line["round"],
                .repeat = line["repeat"],
                .session = line["session"],
                .times = {.totalNs = line["total_ns"], .stages = {}},
                .error = line.value("error", Json())};
  for (const auto& [stage, ns] : line["stages"].items()) sample.times.stages.emplace_back(stage, ns);
  return sample;
}

void take(Record& record, const Json& line) {
  const std::string kind = line.at("kind");
  if (kind == "session") {
    record.sessions = line.at("session").get<unsigned>() + 1;
    return;
  }
  CellRecord& cell = record.cells.at(line.at("cell"));
  if (kind == "cell") {
    cell.row = line.at("row");
    cell.frameS = line.at("frame_s");
  } else if (kind == "end") {
    cell.row["status"] = line.at("status");
    cell.row["message"] = line.at("message");
  } else if (kind == "sample") {
    (line.contains("again") ? cell.again : cell.samples).push_back(sampleOf(line));
  }
}

void takeHead(Record& record, const fs::path& path, const Json& line) {
  const int version = line.at("schema_version");
  if (line.at("kind") != "head") throw std::out_of_range("head");
  if (version != kRowSchemaVersion)
    failUsage(
        fmt::format("{}:1: rows of version {}, this program's have {}; the program that began it goes on with it, or a "
                    "new folder begins anew",
                    path.string(), version, kRowSchemaVersion));
  record.head = line;
  for (const auto& cell : line.at("cells")) record.cells[cell.at("cell")];
}

}  // namespace

fs::path journalOf(const fs::path& folder) { return folder / "journal.jsonl"; }

Record readJournal(const fs::path& folder) {
  const fs::path path = journalOf(folder);
  const std::string text = readFile(path);
  Record record;
  std::size_t number = 1;
  for (std::size_t begin = 0, end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1, ++number) {
    try {
      const Json line = Json::parse(text.begin() + static_cast<std::ptrdiff_t>(begin),
                                    text.begin() + static_cast<std::ptrdiff_t>(end));
      if (number == 1)
        takeHead(record, path, line);
      else
        take(record, line);
    } catch (const Error&) {
      throw;
    } catch (const std::exception&) {
      failUsage(fmt::format("{}:{}: no line of a sweep's journal; a folder that `tessera sweep` has written would do",
                            path.string(), number));
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
  const fs::path journal = journalOf(folder), half = folder / uniqueName(journal.filename().string());
  int failure = writeBeside(half, lineOf(head)) ? 0 : EIO;
  // A sweep that was begun here in the meantime keeps its journal.
  if (failure == 0 && renameat2(AT_FDCWD, half.c_str(), AT_FDCWD, journal.c_str(), RENAME_NOREPLACE) != 0)
    failure = errno;
  if (failure == 0) return;
  fs::remove(half, error);
  if (failure == EEXIST)
    failUsage(fmt::format("{}: another sweep has begun there meanwhile; another folder begins anew", folder.string()));
  fail(fmt::format("{}: could not be written; a folder that can be written, with room in it, would do",
                   journal.string()));
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
