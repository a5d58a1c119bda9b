// What a results folder has to hold, or not, before a sweep writes to it.
#pragma once

#include <filesystem>
#include <optional>

#include "experiments/harness/journal.h"

namespace tessera::harness {

/// The journal of a folder with which the sweep goes on; none where it begins. Throws kUsage, with nothing touched, for
/// a folder that holds other things, and for one that holds a sweep where `resume` was not asked for.
std::optional<Record> recordOf(const std::filesystem::path& folder, bool resume);

/// Removes what a killed sweep was writing beside its files.
void removeHalfFiles(const std::filesystem::path& folder);

}  // namespace tessera::harness
