// One kernel from Slang to a binary, by slangc and, for two of the routes, a second compiler.
#pragma once

#include <tessera/kernel-cache.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "host/kernels/compiler-tools.h"

namespace tessera::kernels {

/// All that decides what comes out, but for the text of the sources.
struct CompileSettings {
  ToolInfo slangc;
  CxxInfo cxx;       ///< of routes that go on from C++
  ToolInfo glslang;  ///< of routes that go on from GLSL
  std::filesystem::path slangSources;
  bool boundsChecks = false;          ///< RouteInfo::compiledChecks
  std::vector<std::string> cxxFlags;  ///< after those of cxxBaseFlags()
};

/// Flags of every C++ kernel. They leave IEEE results alone: -ffp-contract=off keeps x * y + z two operations;
/// -fno-math-errno and -fno-trapping-math give up errno and the exception flags, which nobody reads, so that square
/// roots and selects become vectors.
const std::vector<std::string>& cxxBaseFlags();
/// Name of the entry point in the binary.
std::string binaryEntry(const KernelRequest& request);

/// Compiles into `work`, an existing folder of its own, leaving the binary under RouteInfo::binary. `sources` is what
/// slangSources() found. Throws kFailure: stage, variant, and the compiler's first error with file and line.
KernelInterface compileKernel(const KernelRequest& request, const CompileSettings& settings,
                              const std::map<std::filesystem::path, std::string>& sources,
                              const std::filesystem::path& work);

/// What slangc writes of a Slang kernel for another target; of C++ with what stands ahead of it. Throws as
/// compileKernel() does.
struct Written {
  std::string text, reflection;  ///< the latter as JSON
};
Written writtenBySlang(const KernelRequest& request, const std::string& target, const ToolInfo& slangc,
                       const std::filesystem::path& slangSources);

}  // namespace tessera::kernels
