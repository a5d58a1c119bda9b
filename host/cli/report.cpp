// tessera report: from a sweep's rows to a page, figures and an export. Python makes them: the package
// tessera_report, run from experiments/report.
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "experiments/harness/rows.h"
#include "host/cli/commands.h"
#include "host/cli/common.h"
#include "host/kernels/compiler-tools.h"
#include "host/measure/row.h"
#include "host/support/home.h"
#include "host/support/own-files.h"
#include "host/support/terminal.h"

namespace tessera::cli {
namespace {

namespace fs = std::filesystem;

struct ReportOptions {
  std::string folder, out, exported;
  bool allDevices = false, quiet = false;
};

/// What is reported, and the report's folder unless another is asked for.
struct Place {
  fs::path rows, report;
};

/// Rows come from the journal where there is one; a folder of merged rows has none. A committed experiment has
/// results.jsonl, and stays as it is.
Place bringRowsUpToDate(const fs::path& folder) {
  std::error_code error;
  const std::string sweepFirst = fmt::format("'tessera sweep SWEEP.toml --out {}' makes them", folder.string());
  if (!fs::is_directory(folder, error))
    failUsage(fmt::format("{}: not a folder; a sweep's results are one, and {}", folder.string(), sweepFirst));
  const fs::path rows = folder / "rows.jsonl", journal = folder / "journal.jsonl";
  const bool haveRows = fs::exists(rows, error), haveJournal = fs::exists(journal, error);
  const fs::path results = folder / "results.jsonl";
  if (!haveRows && !haveJournal && fs::exists(results, error))
    return {results, fs::path("out") / "report" / fs::canonical(folder).filename()};
  if (!haveRows && !haveJournal)
    failUsage(fmt::format("{}: neither rows.jsonl, journal.jsonl nor results.jsonl is there: nothing to report; {}",
                          folder.string(), sweepFirst));
  // Not by the files' times, which a copy changes.
  if (haveJournal) harness::deriveRows(folder);
  return {rows, folder / "report"};
}

/// $TESSERA_PYTHON, else that of the environment which ./dev makes and `cmake --install` copies, else of the one that
/// the message says how to make.
std::string pythonProgram() {
  if (const char* python = std::getenv("TESSERA_PYTHON"); python != nullptr && *python != '\0') return python;
  const fs::path python = support::home().python;
  if (access(python.c_str(), X_OK) == 0) return python;  // not so where it is a link to a Python that is not here
  if (!support::home().installed)
    fail(
        fmt::format("{}: not there; './dev build' installs what reports are made with, or set TESSERA_PYTHON to a "
                    "Python 3.11 that has what tools/report.txt lists",
                    python.string()));
  const fs::path own = support::defaultCacheFolder() / "report", ownPython = own / "bin/python";
  if (access(ownPython.c_str(), X_OK) == 0) return ownPython;
  fail(
      fmt::format("{} does not run here; 'python3.11 -m venv {} && {} install --require-hashes -r {}' installs "
                  "what reports are made with, or set TESSERA_PYTHON to a Python 3.11 that has it",
                  python.string(), quoted(own.string()), quoted((own / "bin/pip").string()),
                  quoted(support::home().pins.string())));
}

ExitCode runReport(const ReportOptions& options) {
  const Place place = bringRowsUpToDate(options.folder);
  const std::string report = options.out.empty() ? place.report.string() : options.out;
  // -I: neither the user's own packages nor $PYTHONPATH may get between; -B: nothing is written beside the sources.
  const std::string schema = std::to_string(measure::kRowSchemaVersion);
  std::vector<std::string> words{
      pythonProgram(), "-I",       "-B",  support::home().report.string(), place.rows.string(), "--out",
      report,          "--schema", schema};
  if (!options.exported.empty()) words.insert(words.end(), {"--export", options.exported});
  if (options.allDevices) words.push_back("--all-devices");
  std::vector<char*> arguments;
  for (auto& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  support::flushStdout();
  if (options.quiet && std::freopen("/dev/null", "w", stdout) == nullptr) fail("/dev/null: could not be opened");
  // This process becomes Python, whose exit code and signals are then its own.
  execvp(arguments[0], arguments.data());
  fail(fmt::format("{}: {}; TESSERA_PYTHON should be a Python 3.11 that has what tools/report.txt lists", words[0],
                   std::strerror(errno)));
}

}  // namespace

Command addReport(CLI::App& app) {
  auto options = std::make_shared<ReportOptions>();
  auto* const command = app.add_subcommand(
      "report", "make a page and figures from a sweep's results: DIR/report/index.html and DIR/report/figures");
  command
      ->add_option("DIR", options->folder,
                   "a sweep's folder, one with rows.jsonl and sweep.toml, or an experiment's with results.jsonl")
      ->required();
  command
      ->add_option("--out", options->out,
                   "the report's folder; without it DIR/report, of results.jsonl out/report/NAME")
      ->type_name("FOLDER");
  command->add_option("--export", options->exported, "the rows as a table, too")->type_name("FILE.parquet|FILE.duckdb");
  command->add_flag("--all-devices", options->allDevices,
                    "software drivers' times on the plots, too, marked in their names");
  addQuiet(*command, options->quiet);
  command->footer(
      "Examples:\n"
      "  tessera sweep experiments/tile-size/sweep.toml --quick --out out/tile\n"
      "  tessera report out/tile --export tile.parquet\n"
      "  tessera report experiments/tile-size");
  return {command, [options] { return runReport(*options); }};
}

}  // namespace tessera::cli
