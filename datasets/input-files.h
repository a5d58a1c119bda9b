// Which files an INPUT of the command line is made of.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tessera::datasets {

/// The files that loadInput() reads: the input, and those that a scene names. Nothing is said of what is wrong with
/// them.
std::vector<std::filesystem::path> inputFiles(const std::string& input);

}  // namespace tessera::datasets
