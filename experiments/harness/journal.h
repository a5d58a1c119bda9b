// journal.jsonl, the one record of a sweep: a line for its head, each session, each cell that was checked or ended,
// each sample. Rows are made of it and of nothing else.
//
//   head     schema_version, sweep {title, question, sha256}, quick, rounds, devices, repeats, warm_up, time_limit,
//   seed, jobs
//            (names), cells: cell, name, command and `sweep` as rows have them
//   session  session (0, or how often the sweep had been resumed), utc, load (averages over 1, 5, 15 minutes), jobs:
//            the provenance of each that had something left to do; null where no worker came to plan it
//   cell     cell, session, frame_s (seconds of a frame), row: as the check left it
//   end      cell, session, status, message: what ended a cell after its check
//   sample   cell, round, repeat, session, total_ns, stages, error (of variants that differ from run to run), again:
//            true where the cell had a sample of this round already
#pragma once

#include <tessera/rasterizer.h>

#include <chrono>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "experiments/harness/request.h"

namespace tessera::harness {

struct Sample {
  unsigned round = 0, repeat = 0, session = 0;
  FrameTimes times;
  Json error;  ///< null where it was not measured
};

struct PointRecord {
  Json row;           ///< null: not checked yet
  double frameS = 0;  ///< seconds of a frame; 0: not known
  std::vector<Sample> samples, again;
};

struct Record {
  Json head;
  unsigned sessions = 0;
  std::map<std::size_t, PointRecord> cells;  ///< all of the head's
  std::size_t bytes = 0;                    ///< of whole lines: what is behind them was being written when it ended
};

std::filesystem::path journalOf(const std::filesystem::path& folder);

/// Throws kUsage, with file and line, for what is no journal of this version: each line is as this program writes it,
/// after those before it and says no other thing than they (JournalRules), and the rows that come of it are as
/// row.schema.json has them.
Record readJournal(const std::filesystem::path& folder);

/// The journal, open for more lines. One process at a time holds it.
class Journal {
 public:
  /// A new one of one line, written beside and renamed: a journal has its head or is not there. Throws kUsage where
  /// there is one by now.
  static void create(const std::filesystem::path& folder, const Json& head);
  /// Throws kUsage when another sweep writes to it. Nothing is changed yet.
  explicit Journal(const std::filesystem::path& folder);
  ~Journal();
  Journal(const Journal&) = delete;

  /// Cuts off what is behind the whole lines, which have `bytes`. Throws kUsage where another sweep has added to them.
  void cut(std::size_t bytes);
  /// One write. Throws kFailure when it does not fit, and leaves whole lines behind.
  void append(const Json& line);

 private:
  [[noreturn]] void failed(int error);

  const std::filesystem::path path_;
  int file_ = -1;
  std::size_t bytes_ = 0;
  std::chrono::steady_clock::time_point synced_;
};

}  // namespace tessera::harness
