// A reader and valid files for it, small ones that use much of their format.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace tessera::test {

struct Target {
  std::string name;  ///< of the file that it reads, too
  std::string extension;
  std::vector<std::string> seeds;
  std::function<void(const std::filesystem::path&)> read;
};

/// `folder` is where seeds are made that a writer of ours makes.
std::vector<Target> targets(const std::filesystem::path& folder);

}  // namespace tessera::test
