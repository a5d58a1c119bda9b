#include "experiments/harness/runner.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tessera/error.h>
#include <tessera/input.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <set>

#include "datasets/text.h"
#include "experiments/harness/cells.h"
#include "experiments/harness/fields.h"
#include "experiments/harness/folder.h"
#include "experiments/harness/journal.h"
#include "experiments/harness/rows.h"
#include "experiments/harness/schedule.h"
#include "experiments/harness/summary.h"
#include "experiments/harness/worker-process.h"
#include "host/measure/row.h"
#include "host/support/files.h"
#include "host/support/progress.h"
#include "host/support/sha256.h"
#include "host/support/suggest.h"
#include "host/support/terminal.h"

namespace tessera::harness {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

Json sweepJson(const Sweep& sweep, const SweepPoint& cell) {
  const SweepScene& scene = sweep.scenes[cell.scene];
  Json json{{"title", sweep.title},   {"question", sweep.question},  {"sha256", sweep.sha256}, {"cell", cell.number},
            {"group", cell.group},    {"reference", cell.reference}, {"twin", cell.twin},      {"asked", cell.labels},
            {"swept", Json::array()}, {"scene", scene.name}};
  for (const SweptAxis& axis : sweptAxes(sweep)) json["swept"].push_back(axis.axis);
  if (scene.x) json["x"] = *scene.x;
  json["device"] = cell.device;
  json["threads"] = cell.threads;
  if (sweep.quick) json["quick"] = true;
  return json;
}

Json headOf(const Sweep& sweep, const std::vector<SweepPoint>& cells, const std::vector<Job>& jobs) {
  Json head{{"kind", "head"},
            {"schema_version", measure::kRowSchemaVersion},
            {"sweep", {{"title", sweep.title}, {"question", sweep.question}, {"sha256", sweep.sha256}}},
            {"quick", sweep.quick},
            {"rounds", sweep.rounds},
            {"devices", sweep.devices},
            {"repeats", sweep.repeats},
            {"warm_up", sweep.warmUp},
            {"time_limit", sweep.timeLimitS},
            {"seed", sweep.seed},
            {"jobs", Json::array()},
            {"cells", Json::array()}};
  for (const Job& job : jobs) {
    head["jobs"].push_back(job.name);
    for (const std::size_t number : job.cells)
      head["cells"].push_back({{"cell", number},
                               {"name", cellName(sweep, cells[number])},
                               {"command", cellCommand(sweep, cells[number])},
                               {"sweep", sweepJson(sweep, cells[number])}});
  }
  return head;
}

std::vector<Job> chosenJobs(const std::vector<Job>& jobs, const std::vector<std::string>& names) {
  if (names.empty()) return jobs;
  std::vector<std::string> known;
  for (const Job& job : jobs) known.push_back(job.name);
  for (const auto& name : names)
    if (std::ranges::find(known, name) == known.end())
      failUsage(fmt::format("--job {}: no such job; {}", name, support::whatThereIs(name, known)));
  std::vector<Job> chosen;
  for (const Job& job : jobs)
    if (std::ranges::find(names, job.name) != names.end()) chosen.push_back(job);
  return chosen;
}

/// The jobs of --job, or those with which it was begun: these are the only ones that go on.
std::vector<std::string> jobNames(const SweepOptions& options, const std::optional<Record>& record) {
  if (!record) return options.jobs;
  const auto begun = record->head.at("jobs").get<std::vector<std::string>>();
  const std::set<std::string> asked(options.jobs.begin(), options.jobs.end());
  if (!asked.empty() && asked != std::set<std::string>(begun.begin(), begun.end()))
    failUsage(fmt::format("--job: the folder's sweep was begun with {}; without --job it goes on with these",
                          fmt::join(begun, ", ")));
  return begun;
}

/// The rounds and devices of a sweep that was begun. Older journals do not name the devices: they are the file's.
Changes begunChanges(const Record& begun) {
  Changes changes{begun.head.at("rounds").get<unsigned>(), {}};
  for (const Json& device : begun.head.value("devices", Json::array())) changes.devices.push_back(device);
  return changes;
}

/// What was begun goes on if it is the same file, read as it was then.
Sweep sweepOf(const SweepOptions& options, const std::optional<Record>& begun) {
  const bool quick = options.quick || (begun && begun->head.at("quick").get<bool>());
  Changes changes = options.changes;
  if (begun) {
    changes = begunChanges(*begun);
    if (options.changes.rounds != 0 && options.changes.rounds != changes.rounds)
      failUsage(fmt::format("--rounds {}: the sweep in {} was begun with {}; without --rounds it goes on with these",
                            options.changes.rounds, options.folder.string(), changes.rounds));
    if (!options.changes.devices.empty() && !changes.devices.empty() && options.changes.devices != changes.devices)
      failUsage(fmt::format("--devices {}: the sweep in {} was begun with {}; without --devices it goes on with these",
                            fmt::join(options.changes.devices, ","), options.folder.string(),
                            fmt::join(changes.devices, ",")));
  }
  Sweep sweep = readSweep(options.file, quick, changes);
  if (!options.allowKernels && !sweep.foreignKernel.empty()) failUsage(sweep.foreignKernel);
  if (!begun) return sweep;
  const Json& head = begun->head.at("sweep");
  if (head.at("sha256") != sweep.sha256)
    failUsage(
        fmt::format("--out {}: holds the sweep \"{}\" of another file, or of this one as it was before; the file "
                    "as it was resumes it, another folder begins anew",
                    options.folder.string(), head.at("title").get<std::string>()));
  if (quick != begun->head.at("quick").get<bool>())
    failUsage(
        fmt::format("--quick: the sweep in {} was begun without; without it, it goes on", options.folder.string()));
  return sweep;
}

class Runner {
 public:
  Runner(const SweepOptions& options, std::optional<Record> begun)
      : folder_(options.folder),
        sweep_(sweepOf(options, begun)),
        cells_(cells(sweep_)),
        jobs_(chosenJobs(jobs(sweep_, cells_), jobNames(options, begun))),
        begun_(std::move(begun)),
        schedule_(sweep_, cells_, jobs_, begun_ ? begunRecord() : emptyRecord()) {}

  bool isDone() const {
    return std::ranges::all_of(jobs_, [&](const Job& job) { return schedule_.isDone(job); });
  }

  /// Rows of jobs that have ended stay, so their scenes have to be what they were.
  void checkEnded() const {
    for (const Job& job : jobs_) {
      if (!begun_ || !schedule_.isDone(job)) continue;
      const SweepScene& scene = sweep_.scenes[job.scene];
      std::map<std::pair<std::uint32_t, std::uint32_t>, std::string> hashes;  // by width and height
      for (const std::size_t number : job.cells) {
        const Json& before = begun_->cells.at(number).row;
        if (!hasScene(before)) continue;
        const auto& [width, height] = cells_[number].size;
        std::string& hash = hashes[{width, height}];
        if (hash.empty()) hash = sceneHash(loadInput(scene.input, width, height, scene.attribute));
        checkScene(number, before, hash);
      }
    }
  }

  void run() {
    for (const Job& job : jobs_)
      if (!schedule_.isDone(job)) prepare(job);
    open();
    support::Progress progress("sweep", schedule_.steps());
    progress_ = &progress;
    for (const Job& job : jobs_) {
      if (schedule_.isDone(job)) continue;
      job_ = &job;
      check();
      for (unsigned round = 0; round < sweep_.rounds; ++round)
        for (const Turn& turn : schedule_.turns(job, round))
          if (schedule_.runs(turn.cell)) take(turn);
      stopWorker();
    }
  }

  std::size_t steps() const { return schedule_.steps(); }
  std::size_t done() const { return schedule_.done(); }
  bool isOpen() const { return journal_ != nullptr; }
  void close() { journal_.reset(); }

 private:
  Record emptyRecord() const {
    Record record;
    for (const Job& job : jobs_)
      for (const std::size_t number : job.cells) record.cells[number];
    return record;
  }

  /// The record, with its references for those of the file; all else in its head has to be what the file gives.
  const Record& begunRecord() {
    const Json& begun = begun_->head;
    for (const Json& cell : begun.at("cells")) {
      const std::size_t number = cell.at("cell");
      if (number < cells_.size() && !cells_[number].twin && flagAt(cell.at("sweep"), "reference"))
        makeReference(cells_, number);
    }
    const auto hold = [&](const std::string& key, const std::string& own, const std::string& found) {
      if (own != found)
        failUsage(
            fmt::format("{}:1: {}: is not what the sweep's file gives; the journal as it was resumes it, another "
                        "folder begins anew",
                        journalOf(folder_).string(), key));
    };
    const Json own = headOf(sweep_, cells_, jobs_);
    for (const auto& [key, value] : own.items())
      if (key != "cells" && begun.contains(key)) hold(key, lineOf(value), lineOf(begun.at(key)));
    const auto textOf = [](const Json& head, std::size_t i, const char* key) {
      return i < head.at("cells").size() ? lineOf(head.at("cells")[i].at(key)) : "";
    };
    for (std::size_t i = 0; i < std::max(own.at("cells").size(), begun.at("cells").size()); ++i)
      for (const char* const key : {"cell", "name", "command", "sweep"})
        hold(fmt::format("cells.{}.{}", i, key), textOf(own, i, key), textOf(begun, i, key));
    return *begun_;
  }

  Json requestOf(const Job& job) const {
    const SweepScene& scene = sweep_.scenes[job.scene];
    WorkerJob request{.input = scene.input,
                      .attribute = scene.attribute,
                      .device = job.device,
                      .truth = sweep_.truth,
                      .warmUp = sweep_.warmUp,
                      .timeLimitS = sweep_.timeLimitS,
                      .seed = sweep_.seed,
                      .folder = fs::absolute(folder_),
                      .cells = {}};
    for (const std::size_t number : job.cells) {
      const SweepPoint& cell = cells_[number];
      if (!schedule_.checked(number) || schedule_.runs(number))
        request.cells.push_back({number, cell.size, cell.threads, cell.asked, cell.kernels});
    }
    return toJson(request);
  }

  // ---- workers

  /// Whether it became ready for the job; `ending_` says why not.
  bool startWorker(const Job& job) {
    stopWorker();
    worker_ = std::make_unique<WorkerProcess>(interrupts_);
    worker_->send(requestOf(job));
    while (auto message = receive()) {
      if (message->at("event") == "ready") return true;
      if (message->at("event") == "planned") {
        planned(message->at("cell"), message->at("row"));
        if (message->contains("refused")) refused_.insert(message->at("cell").get<std::size_t>());
      }
    }
    return false;
  }

  void stopWorker() { worker_.reset(); }

  /// None when the worker has ended; `ending_` then says how.
  std::optional<Json> receive() {
    auto message = worker_->receive();
    if (!message) {
      ending_ = worker_->ending();
      stopWorker();
    } else if (message->at("event") == "failed") {
      throw Error(static_cast<ExitCode>(message->at("code").get<int>()), message->at("message"));
    }
    return message;
  }

  /// False for a cell that ended before its scene was read.
  static bool hasScene(const Json& row) { return !row.is_null() && row.at("scene").contains("sha256"); }

  void checkScene(std::size_t number, const Json& before, const std::string& hash) const {
    if (before.at("scene").at("sha256") == hash) return;
    failUsage(
        fmt::format("{}: its scene is not what it was when this sweep began; the scene as it was resumes it, "
                    "another folder begins anew",
                    nameOf(number)));
  }

  /// What the journal has of the cell has to be of this scene on this machine.
  void planned(std::size_t number, const Json& row) {
    planned_[number] = row;
    if (!begun_) return;
    const Json& before = begun_->cells.at(number).row;
    if (!hasScene(before)) return;
    checkScene(number, before, row.at("scene").at("sha256"));
    const std::string name = nameOf(number);
    const auto part = [](const Json& of, const char* which) { return of.at("provenance").value(which, Json()).dump(); };
    for (const char* const which :
         {"device", "driver", "threads", "cpu", "os", "git", "compiler", "kernel_compiler", "slang"})
      if (part(before, which) != part(row, which))
        failUsage(fmt::format(
            "{}: this sweep began on another machine or build, where {} was {}, not {}; that one resumes it, "
            "another folder begins anew",
            name, which, part(before, which), part(row, which)));
    for (const auto& [stage, file] : cells_[number].kernels)
      if (const Json files = before.value("kernel_files", Json::object());
          files.contains(stage) && files.at(stage).at("sha256") != support::sha256(datasets::readFile(file)))
        failUsage(
            fmt::format("{}: {} is not what it was when this sweep began; as it was it resumes it, another folder "
                        "begins anew",
                        name, file.string()));
  }

  /// Inputs are read, devices opened and kernels compiled before anything is written: what is wrong with inputs and
  /// devices is said at once; a kernel that does not compile costs the cells that take it, whose checks say so.
  void prepare(const Job& job) {
    provenance_[job.name] = nullptr;
    const bool ready = startWorker(job);
    // A worker knows the twin as it was told: of another one it is told anew.
    if (ready && !begun_ && chooseReferences(sweep_, cells_, [&](std::size_t number) {
          return refused_.contains(number) || !planned_.contains(number);
        }))
      stopWorker();
    for (const std::size_t number : job.cells)
      if (planned_.contains(number)) provenance_[job.name] = planned_[number].at("provenance");
    if (std::ranges::count_if(jobs_, [&](const Job& j) { return !schedule_.isDone(j); }) > 1) stopWorker();
  }

  void open() {
    if (!begun_) Journal::create(folder_, headOf(sweep_, cells_, jobs_));
    journal_ = std::make_unique<Journal>(folder_);
    if (begun_) journal_->cut(begun_->bytes);
    removeHalfFiles(folder_);
    // The report reads [plot] from it.
    if (!fs::exists(folder_ / "sweep.toml")) support::writeWhole(folder_ / "sweep.toml", sweep_.text);
    session_ = begun_ ? begun_->sessions : 0;
    double load[3] = {};
    getloadavg(load, 3);
    journal_->append({{"kind", "session"},
                      {"session", session_},
                      {"utc", measure::utcText()},
                      {"load", {load[0], load[1], load[2]}},
                      {"jobs", provenance_}});
  }

  /// The worker there is, or a new one in place of one that has ended.
  bool haveWorker() { return worker_ || startWorker(*job_); }

  // ---- cells

  std::string nameOf(std::size_t number) const { return cellName(sweep_, cells_[number]); }

  void say(const std::string& what) { progress_->at(schedule_.done(), what, left()); }

  std::optional<double> left() const {
    const std::size_t open = cellCount() - schedule_.cellsChecked();
    const double usual = checks_ > 0 ? checkS_ / static_cast<double>(checks_) : 0;
    const double seconds = schedule_.secondsLeft() + static_cast<double>(open) * usual;
    return seconds > 0 ? std::optional(seconds) : std::nullopt;
  }
  std::size_t cellCount() const {
    std::size_t count = 0;
    for (const Job& job : jobs_) count += job.cells.size();
    return count;
  }

  void record(std::size_t number, const Json& row, double frameS) {
    journal_->append({{"kind", "cell"}, {"cell", number}, {"session", session_}, {"frame_s", frameS}, {"row", row}});
    schedule_.check(number, textAt(row, "status") == "ok", frameS);
  }

  /// What there is to say of a cell that ended before its check did.
  Json rowWithout(std::size_t number, const std::string& status, const std::string& message) {
    Json row;
    if (const auto found = planned_.find(number); found != planned_.end()) {
      row = found->second;
    } else {
      measure::Run run;
      run.variant = cells_[number].asked;
      run.truth = sweep_.truth;
      run.seed = sweep_.seed;
      row = Json::parse(measure::rowText(run));
      const SweepPoint& cell = cells_[number];
      row["scene"] = {{"name", sweep_.scenes[cell.scene].name}, {"size", {cell.size.width, cell.size.height}}};
    }
    row["status"] = status;
    row["message"] = message;
    return row;
  }

  void check() {
    for (const std::size_t number : job_->cells) {
      if (schedule_.checked(number)) continue;
      say(fmt::format("{} of {} cells checked: {}", schedule_.cellsChecked(), cellCount(), nameOf(number)));
      const auto begin = Clock::now();
      if (!haveWorker()) {
        record(number, rowWithout(number, "error", ending_ + " before it was ready"), 0);
        continue;
      }
      worker_->send({{"do", "check"}, {"cell", number}});
      const auto message = receive();
      if (!message) {
        record(number, rowWithout(number, "error", ending_ + " in its check"), 0);
      } else if (message->at("event") == "ended") {
        record(number, rowWithout(number, message->at("status"), message->at("message")), 0);
        stopWorker();
      } else {
        record(number, message->at("row"), message->at("frame_s"));
        if (message->at("row").at("status") == "error") stopWorker();  // a device that failed is not for the next cell
      }
      ++checks_;
      checkS_ += secondsSince(begin);
    }
  }

  void end(std::size_t number, const std::string& status, const std::string& message) {
    journal_->append(
        {{"kind", "end"}, {"cell", number}, {"session", session_}, {"status", status}, {"message", message}});
    schedule_.end(number);
    stopWorker();  // whatever it was, the next cell is not to have it
  }

  void take(const Turn& turn) {
    say(fmt::format("round {} of {}: {}", turn.round + 1, sweep_.rounds, nameOf(turn.cell)));
    const auto begin = Clock::now();
    bool warm = true;
    for (unsigned repeat = 0; repeat < sweep_.repeats; ++repeat) {
      const bool again = std::ranges::find(turn.again, repeat) != turn.again.end();
      if (!again && std::ranges::find(turn.repeats, repeat) == turn.repeats.end()) continue;
      if (!haveWorker()) return end(turn.cell, "error", ending_ + " before it was ready");
      // A worker waits while its sample is written: nothing runs beside a frame.
      worker_->send({{"do", "time"}, {"cell", turn.cell}, {"warm", warm}});
      warm = false;
      const auto message = receive();
      if (!message) return end(turn.cell, "error", ending_ + " in a timed frame");
      if (message->at("event") == "ended") return end(turn.cell, message->at("status"), message->at("message"));
      Json line{{"kind", "sample"},
                {"cell", turn.cell},
                {"round", turn.round},
                {"repeat", repeat},
                {"session", session_},
                {"total_ns", message->at("total_ns")},
                {"stages", message->at("stages")}};
      if (message->contains("error")) line["error"] = message->at("error");
      if (again) line["again"] = true;
      journal_->append(line);
      if (!again) schedule_.sample(turn.cell, turn.round, repeat);
    }
    if (turn.repeats.size() + turn.again.size() == sweep_.repeats) schedule_.took(turn.cell, secondsSince(begin));
  }

  const fs::path folder_;
  const Sweep sweep_;
  std::vector<SweepPoint> cells_;
  const std::vector<Job> jobs_;
  const std::optional<Record> begun_;
  Schedule schedule_;
  Interrupts interrupts_;
  std::unique_ptr<WorkerProcess> worker_;
  std::unique_ptr<Journal> journal_;
  std::map<std::size_t, Json> planned_;  ///< rows of cells as they were before they had rendered
  std::set<std::size_t> refused_;        ///< by the planner
  Json provenance_ = Json::object();     ///< of the jobs
  std::string ending_;
  unsigned session_ = 0;
  const Job* job_ = nullptr;
  support::Progress* progress_ = nullptr;
  std::size_t checks_ = 0;
  double checkS_ = 0;
};

}  // namespace

void runSweep(const SweepOptions& options) {
  auto begun = recordOf(options.folder, options.resume);
  const bool resumed = begun.has_value();
  Runner runner(options, std::move(begun));
  const bool wasDone = runner.isDone();
  runner.checkEnded();
  try {
    if (!wasDone) runner.run();
  } catch (const Interrupted&) {
    if (!runner.isOpen()) throw Error(ExitCode::kInterrupted, "sweep: stopped before anything more was rendered");
    runner.close();
    deriveRows(options.folder);
    throw Error(ExitCode::kInterrupted, fmt::format("sweep: stopped with {} of {} steps done; --resume goes on with {}",
                                                    runner.done(), runner.steps(), options.folder.string()));
  }
  runner.close();
  deriveRows(options.folder);
  if (options.quiet) return;
  if (resumed && wasDone)
    support::say(stdout, "{}: the sweep had ended already: nothing was left to do\n", options.folder.string());
  else
    support::say(stdout, "{}", summaryOf(readJournal(options.folder), options.folder));
}

}  // namespace tessera::harness
