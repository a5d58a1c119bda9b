// How long a sweep will take on this machine, by measuring a little of it.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "experiments/harness/survey.h"

namespace tessera::harness {

struct Estimate {
  double seconds = 0;
  bool nothing = true;             ///< no cell runs here
  std::size_t others = 0;          ///< cells that run here and are no references, of which
  std::size_t fromRows = 0;        ///< these have a ratio to their reference in results.jsonl; the rest count as 1
  std::size_t unmeasured = 0;      ///< cells that are not counted: their group's reference failed
  std::string whyNot;              ///< the last of these: one line
  std::size_t uncompiled = 0;      ///< kernels that are still to be compiled
  bool compilingIsCounted = true;  ///< false where nothing was compiled now, so that its time is not known
};

/// Renders each group's reference twice and one of the oracle's images of each scene and size, and counts what the
/// cells, rounds and images make of these times. A cell's ratio to its reference comes from `results.jsonl` beside the
/// sweep file where that has rows of its scene, device and variant. Compiles the references' kernels. Frames are
/// counted as the time limit at most.
Estimate estimate(const Sweep& sweep, const std::vector<SweepPoint>& cells, const Survey& survey);

}  // namespace tessera::harness
