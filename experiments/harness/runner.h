// A sweep from its file to a results folder: jobs, rounds and turns, each job in a worker process.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/harness/sweep-file.h"

namespace tessera::harness {

struct SweepOptions {
  std::filesystem::path file;     ///< sweep.toml
  std::filesystem::path folder;   ///< of the results
  bool resume = false;            ///< go on with what the folder holds; begins where it holds nothing
  bool quick = false;             ///< as [quick] says; what was begun so goes on so
  bool allowKernels = false;      ///< run kernels that lie outside the file's folder
  bool quiet = false;             ///< no summary
  Changes changes;                ///< of the file; what was begun goes on with those it was begun with
  std::vector<std::string> jobs;  ///< names of those to do; empty: all, or those with which it was begun
};

/// Runs or resumes it, writes rows.jsonl and prints a summary. Throws kUsage before anything is written for an input, a
/// device or a folder that will not do, kInterrupted when a signal stopped it, kFailure when the folder cannot be
/// written.
void runSweep(const SweepOptions& options);

}  // namespace tessera::harness
