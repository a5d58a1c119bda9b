// What a sweep came to, for people.
#pragma once

#include <filesystem>
#include <string>

#include "experiments/harness/journal.h"

namespace tessera::harness {

/// Cells by status, a line for each that is not ok, and a table for each group of cells, of at most some 40 lines.
std::string summaryOf(const Record& record, const std::filesystem::path& folder);

}  // namespace tessera::harness
