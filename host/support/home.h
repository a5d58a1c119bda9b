// Where the files that come with Tessera lie: below the prefix of an installed program, else in the clone of the build.
#pragma once

#include <filesystem>

namespace tessera::support {

/// An installed program uses what was installed with it, wherever its prefix was moved, and nothing of the clone.
/// Paths are those where a file would be: whether it is there is the caller's question.
struct Home {
  bool installed = false;
  std::filesystem::path slang;   ///< folder of the kernels' Slang sources
  std::filesystem::path slangc;  ///< the pinned compiler
  std::filesystem::path report;  ///< Python package that makes reports
  std::filesystem::path python;  ///< of the environment that has what reports need
  std::filesystem::path pins;    ///< what that environment is made of, for pip
};

/// Of the running program.
const Home& home();

/// The pinned slangc that belongs to these sources, be they a clone's or those of an installed library; else home()'s.
std::filesystem::path slangcOf(const std::filesystem::path& slangSources);

}  // namespace tessera::support
