// The commands of the command line, one a file. Results go to stdout, messages and progress to stderr.
#pragma once

#include <tessera/error.h>

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "experiments/harness/sweep-file.h"

namespace tessera::cli {

/// A sub-command and what runs it once it has been parsed. Failures leave as Error.
struct Command {
  CLI::App* app;
  std::function<ExitCode()> run;
};

Command addRender(CLI::App& app);
Command addParity(CLI::App& app);
Command addCompare(CLI::App& app);
Command addPlan(CLI::App& app);
Command addDevices(CLI::App& app);
Command addVariants(CLI::App& app);
Command addMeshes(CLI::App& app);
Command addKernels(CLI::App& app);
Command addExpand(CLI::App& app);
Command addSweep(CLI::App& app);
/// --rounds and --devices of expand and sweep.
void addChanges(CLI::App& app, harness::Changes& changes);
Command addReport(CLI::App& app);
Command addHelp(CLI::App& app);
Command addCompletion(CLI::App& app);
Command addComplete(CLI::App& app);  ///< hidden: what the shells ask
Command addMan(CLI::App& app);
Command addVersion(CLI::App& app, const std::string& version);
Command addSweepWorker(CLI::App& app);  ///< hidden: what `sweep` starts for each job

}  // namespace tessera::cli
