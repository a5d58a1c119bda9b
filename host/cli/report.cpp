// tessera report: from a sweep's rows to a page, figures and an export. Python makes them, from experiments/report.
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
#include "host/row.h"

namespace tessera::cli {
namespace {

namespace fs = std::filesystem;

struct ReportOptions {
  std::string folder, exported;
  bool allDevices = false;
};

/// Rows come from the journal where there is one; a folder of merged rows has none.
void bringRowsUpToDate(const fs::path& folder) {
  std::error_code error;
  const std::string sweepFirst = fmt::format("'tessera sweep SWEEP.toml --out {}' makes them", folder.string());
  if (!fs::is_directory(folder, error))
    failUsage(fmt::format("{}: not a folder; a sweep's results are one, and {}", folder.string(), sweepFirst));
  const fs::path rows = folder / "rows.jsonl", journal = folder / "journal.jsonl";
  const bool haveRows = fs::exists(rows, error), haveJournal = fs::exists(journal, error);
  if (!haveRows && !haveJournal)
    failUsage(fmt::format("{}: neither rows.jsonl nor journal.jsonl is there: nothing to report; {}", folder.string(),
                          sweepFirst));
  // Not by the files' times, which a copy changes.
  if (haveJournal) harness::deriveRows(folder);
}

/// $TESSERA_PYTHON, else the environment that ./dev installs.
std::string pythonProgram() {
  if (const char* python = std::getenv("TESSERA_PYTHON"); python != nullptr && *python != '\0') return python;
  const std::string python = TESSERA_REPORT_PYTHON;
  if (access(python.c_str(), X_OK) != 0) {
    fail(fmt::format(
        "{}: not there; './dev build' installs what reports are made with, or set TESSERA_PYTHON to a Python 3.11 "
        "that has what tools/report.txt lists",
        python));
  }
  return python;
}

/// What was installed with this program, else the folder that this build came from.
fs::path reportPackage() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const fs::path installed = program.parent_path().parent_path() / TESSERA_REPORT_INSTALLED;
  return !error && fs::is_directory(installed, error) ? installed : fs::path(TESSERA_REPORT_DIR);
}

ExitCode runReport(const ReportOptions& options) {
  bringRowsUpToDate(options.folder);
  // -I: neither the user's own packages nor $PYTHONPATH may get between; -B: nothing is written beside the sources.
  const std::string schema = std::to_string(kRowSchemaVersion);
  std::vector<std::string> words{
      pythonProgram(), "-I", "-B", reportPackage().string(), options.folder, "--schema", schema};
  if (!options.exported.empty()) words.insert(words.end(), {"--export", options.exported});
  if (options.allDevices) words.push_back("--all-devices");
  std::vector<char*> arguments;
  for (auto& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  std::fflush(stdout);
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
  command->add_option("DIR", options->folder, "a sweep's folder, or one with rows.jsonl and sweep.toml")->required();
  command->add_option("--export", options->exported, "the rows as a table, too")->type_name("FILE.parquet|FILE.duckdb");
  command->add_flag("--all-devices", options->allDevices,
                    "software drivers' times on the plots, too, marked in their names");
  command->footer("Example:\n  tessera report out/tile --export tile.parquet");
  return {command, [options] { return runReport(*options); }};
}

}  // namespace tessera::cli
