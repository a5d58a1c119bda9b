// Rows of a results folder, made from its journal.
#pragma once

#include <filesystem>
#include <string>

#include "experiments/harness/journal.h"

namespace tessera::harness {

double medianOf(std::vector<double> values);  ///< 0 of none

/// A line a cell that has been checked, in the order of the cells. The same for the same journal, byte for byte.
std::string rowsText(const Record& record);
/// Writes them to rows.jsonl. Throws kUsage for a folder without a journal, kFailure when they cannot be written.
void deriveRows(const std::filesystem::path& folder);

}  // namespace tessera::harness
