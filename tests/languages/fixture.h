// Kernels that a user brings, in files of a folder that a test makes.
#pragma once

#include <tessera/rasterizer.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "host/support/files.h"
#include "tests/support/error-line.h"
#include "tests/support/machines.h"

namespace tessera::test {

/// A file of this folder, or of the kernels by hand.
std::filesystem::path example(const std::string& name);

struct Bench {
  support::TemporaryFolder folder;
  Bench();
  /// Writes a file of that name and gives its path.
  std::filesystem::path write(const std::string& name, const std::string& text) const;
  /// The text of an example under the same name, in which each edit's first text, which must be there, is its second.
  using Edits = std::vector<std::pair<std::string, std::string>>;
  std::filesystem::path edited(const std::string& name, const Edits& edits) const;
};

/// A machine whose stages run these files.
Machine machineWith(const std::string& route, const KernelFiles& files);
/// Two overlapping triangles in object space, 40 x 24, that need no clipping and no division.
Scene smallScene();

}  // namespace tessera::test
