// A folder of its own for each test: Slang sources, which tests change, and a kernel cache.
#pragma once

#include <tessera/kernel-cache.h>

#include <filesystem>
#include <string>

#include "host/support/files.h"
#include "tests/support/error-line.h"

namespace tessera::test {

void writeText(const std::filesystem::path& path, const std::string& text);
/// Sets an environment variable for a while; an empty value unsets it.
class Environment {
 public:
  Environment(const char* name, const std::string& value);
  ~Environment();
  Environment(const Environment&) = delete;

 private:
  std::string name_, before_;
};

struct Workshop {
  support::TemporaryFolder folder;
  std::filesystem::path slang, cache;

  /// Sources: stages/scale.slang (entry scaleAll: results[i] = (values[i] * frame.factor + step()) / 3), which
  /// imports step_size, which is step-size.slang, which imports the variant module; unrelated.slang is imported by
  /// none.
  Workshop();
  KernelCache open(bool boundsChecks = false, const std::string& flags = "") const;
};

inline constexpr const char* kVariant = "module variant;\npublic static const int kStep = 1;\n";
KernelRequest scaleRequest(Route route = Route::kCpp, const std::string& variant = kVariant);

/// Files in a folder, at any depth, whose name ends so.
std::size_t countFiles(const std::filesystem::path& folder, const std::string& ending);

}  // namespace tessera::test
