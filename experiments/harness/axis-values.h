// Axes and their values in a sweep file, as text that Variant::set takes.
#pragma once

#include <string>
#include <vector>

#include "datasets/toml-table.h"
#include "experiments/harness/sweep-file.h"

namespace tessera::harness {

/// The value of `entry`, whose key is an axis. Refuses an unknown axis and an unknown value.
std::string readAxisValue(const datasets::TomlTable& table, const datasets::TomlTable::Entry& entry);
/// The same for a list or a range of them, without a value twice.
std::vector<std::string> readAxisValues(const datasets::TomlTable& table, const datasets::TomlTable::Entry& entry);

/// One value or a list of them, of one of the axes that vary. Refuses another axis, and a value that no cell has.
std::vector<std::string> readChosen(const datasets::TomlTable& table, const datasets::TomlTable::Entry& entry,
                                    const std::vector<SweptAxis>& swept);

}  // namespace tessera::harness
