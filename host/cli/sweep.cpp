// tessera sweep: every cell of a sweep file, checked and timed, into a results folder.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "experiments/harness/runner.h"
#include "experiments/harness/worker.h"
#include "host/cli/commands.h"
#include "host/cli/common.h"
#include "host/devices/open.h"
#include "host/support/progress.h"

namespace tessera::cli {

void addChanges(CLI::App& app, harness::Changes& changes) {
  addCount(app, "--rounds", changes.rounds, 1, harness::kMaxRounds, "rounds, in place of the file's");
  app.add_option_function<std::string>(
         "--devices",
         [&changes](const std::string& typed) {
           if (!typed.empty())
             changes.devices =
                 partsOf(typed, "--devices",
                         fmt::format("{}", fmt::join(devices::kindNames(), ",")));  // else it is refused later
         },
         devices::deviceForms() + ", with commas between, in place of the file's")
      ->type_name("DEVICE,...");
}

Command addSweep(CLI::App& app) {
  auto options = std::make_shared<harness::SweepOptions>();
  auto* const command =
      app.add_subcommand("sweep", "run every cell of a sweep file, checked against the oracle and timed");
  command
      ->add_option("SWEEP", options->file, "what varies, on which scenes: a .toml file as experiments/README.md says")
      ->required();
  command->add_option("--out", options->folder, "folder of the results; a new one, or one to --resume")
      ->required()
      ->type_name("DIR");
  command->add_flag("--resume", options->resume, "go on with what the folder holds; begins where it holds nothing");
  command->add_flag("--quick", options->quick, "the smaller sweep that the file's [quick] says");
  addChanges(*command, options->changes);
  addQuiet(*command, options->quiet);
  command->add_option("--job", options->jobs, "only this scene on this device; may be repeated")
      ->type_name("SCENE@DEVICE")
      ->allow_extra_args(false);
  command->add_flag("--allow-kernels", options->allowKernels,
                    "run files of [kernels] that lie outside the sweep's folder: a kernel is native code");
  command->footer(
      "DIR holds journal.jsonl (a line a sample), rows.jsonl (a line a cell) and pictures of differences. Ctrl-C and "
      "kill -9 lose at most the sample that was running. Cells that overflow, are refused, run out of time or fail "
      "are rows with that status, and the exit code is 0; 130 when a signal stopped it.\n\n"
      "Examples:\n"
      "  tessera sweep experiments/tile-size/sweep.toml --quick --out out/tile\n"
      "  tessera sweep experiments/tile-size/sweep.toml --out out/tile --resume\n"
      "  tessera sweep experiments/tile-size/sweep.toml --out out/elephant --job elephant@cpu");
  return {command, [options] {
            harness::runSweep(*options);
            return ExitCode::kDone;
          }};
}

Command addSweepWorker(CLI::App& app) {
  auto* const command = app.add_subcommand("sweep-worker", "")->group("");
  command->add_flag_callback("-q,--quiet", support::Progress::silence);
  return {command, [] { return static_cast<ExitCode>(harness::serveWorker()); }};
}

}  // namespace tessera::cli
