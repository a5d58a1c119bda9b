// Rows of a results folder, made from its journal.
#pragma once

#include <filesystem>
#include <string>

#include "experiments/harness/journal.h"

namespace tessera::harness {

double medianOf(std::vector<double> values);  ///< 0 of none

/// A line a cell that has been checked, in the order of the cells. The same for the same journal, byte for byte.
std::string rowsText(const Record& record);
/// Throws kUsage, with file and line, where rows.jsonl has a row that the journal beside it would not give: of another
/// run or machine, or with samples that the journal has lost. It stays as it is.
void checkRowsKept(const std::filesystem::path& folder, const Record& record);
/// Writes them to rows.jsonl, unless checkRowsKept() throws. Throws kUsage for a folder without a journal, kFailure
/// when they cannot be written.
void deriveRows(const std::filesystem::path& folder);

}  // namespace tessera::harness
