// What the process of a sweep asks of its workers, and how it travels: a line of JSON a message.
//
//   to the worker    a WorkerJob, once; then  {"do": "check" or "time", "cell": N, "warm": whether frames go ahead}
//   from the worker  {"event": "planned", "cell": N, "row": what is known of the cell before it has rendered},
//                    each cell; with "refused" and why where the planner does
//                    {"event": "ready"};
//                    {"event": "checked", "cell": N, "row": {...}, "frame_s": S}, status and all;
//                    {"event": "sample", "total_ns": T, "stages": {...}, "error": {...}};
//                    {"event": "ended", "status": "timeout" or "error" ..., "message": "..."}: the cell is;
//                    {"event": "failed", "code": of ExitCode, "message": "..."}: the sweep cannot go on
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/harness/cells.h"

namespace tessera::harness {

using Json = nlohmann::ordered_json;

struct WorkerPoint {
  std::size_t number = 0;
  Size size;
  unsigned threads = 0;
  Variant asked;
  KernelFiles kernels;
};

/// A job, with all that a worker needs to know of its sweep: the sweep's file may have changed since it was read.
struct WorkerJob {
  std::string input;
  AttributeRequest attribute;
  std::string device;
  Variant truth;
  unsigned warmUp = 1;
  double timeLimitS = 60;
  std::uint64_t seed = 1;
  std::filesystem::path folder;  ///< of the results: pictures/ goes into it
  std::vector<WorkerPoint> cells;
};

Json toJson(const WorkerJob& job);
WorkerJob jobOf(const Json& json);

/// One line; bytes that are not UTF-8 (paths, messages of drivers) are replaced.
std::string lineOf(const Json& json);

}  // namespace tessera::harness
