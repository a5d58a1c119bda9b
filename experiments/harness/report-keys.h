// Keys of a sweep file that the sweep itself does not need: they are checked here, and others read them.
#pragma once

#include "datasets/toml-table.h"
#include "experiments/harness/sweep-file.h"

namespace tessera::harness {

/// [plot]: what the report draws.
void checkPlot(const datasets::TomlTable& plot, const Sweep& sweep);
/// One [[expect]]: what rows must have, whatever their times.
void checkExpectation(const datasets::TomlTable& expect, const Sweep& sweep);

}  // namespace tessera::harness
