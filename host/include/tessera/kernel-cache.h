// Variant -> compiled kernel, by content. Slang comes in here and nowhere else.
#pragma once

#include <tessera/kernel.h>
#include <tessera/variant.h>

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace tessera {

/// One kernel to compile. The generated modules are the only thing that differs between variants of a stage.
struct KernelRequest {
  std::string stage;   ///< for messages and CompiledKernel::stage
  std::string source;  ///< file under slang/, e.g. "stages/raster-tiles.slang"
  std::string entry;   ///< entry point
  Route route = Route::kCpp;        ///< how it is compiled
  VariantModules modules;           ///< the generated modules that it imports
  std::string variantName;          ///< "axis=value axis=value", for messages
  std::filesystem::path file = {};  ///< a user's kernel in place of `source`, see user-kernel.h
};

/// Kernels that a user brings: stage -> file.
using KernelFiles = std::map<std::string, std::filesystem::path>;

/// A compiler that kernels are compiled with.
struct ToolInfo {
  std::filesystem::path path;  ///< where the program lies
  std::string version;         ///< the version, as the program says it
  std::string origin;  ///< "SLANGC", "PATH" or "tools" (the pinned one that ./dev fetched)
};

/// Compiled kernels in a folder of files, content-addressed: the key holds the text of the Slang sources that the
/// kernel imports, the generated modules, flags, slangc's and the C++ compiler's versions, and the resolved CPU target.
/// Safe when two processes fill it at once (written beside, renamed); a broken entry is rebuilt. Thread-safe.
class KernelCache {
 public:
  /// Where the cache lies and how it compiles.
  struct Options {
    std::filesystem::path folder =
        {};  ///< default: $TESSERA_CACHE, else $XDG_CACHE_HOME/tessera, else ~/.cache/tessera
    std::filesystem::path slangSources =
        {};  ///< default: $TESSERA_SLANG_SOURCES, else the installed or source folder known at build time
    bool boundsChecks = false;       ///< kCpp: compile Slang's bounds checks in (asserts)
    std::string extraCxxFlags = {};  ///< kCpp: separated by spaces, after those that the build gave (its sanitizers)
    KernelFiles files =
        {};  ///< stages that run these in place of their own kernels, whatever renders with this cache.
             ///< They are native code; the command line checks their indices first, the library does not
  };
  /// How many kernels this object was asked for, by what it had to do for them.
  struct Statistics {
    std::size_t hits = 0;      ///< kernels that the folder had
    std::size_t compiled = 0;  ///< kernels that were compiled
    std::size_t rebuilt = 0;   ///< broken entries, among the compiled
  };
  KernelCache();  ///< a cache with the default options
  /// Throws kUsage where the Slang sources are not there, and where the folder belongs to another user or can be
  /// written by others. Compilers are looked for when the first kernel needs them.
  explicit KernelCache(Options options);
  ~KernelCache();
  KernelCache(const KernelCache&) = delete;

  /// Whether get() would find it compiled.
  bool has(const KernelRequest& request);
  /// Compiles if it is not there. Throws kFailure with Slang's or the compiler's first message and the variant's name.
  CompiledKernel get(const KernelRequest& request);
  /// Compiles many on all cores; `progress(done, total)` may be empty.
  std::vector<CompiledKernel> getAll(const std::vector<KernelRequest>& requests,
                                     const std::function<void(std::size_t, std::size_t)>& progress = {});

  const KernelFiles& files() const;  ///< those of the options
  const ToolInfo& slangc() const;    ///< the compiler in use: one whose SPIR-V passes checkSpirv()
  std::string cxx() const;           ///< the C++ compiler in use, e.g. "g++ 12.2.0, -O3 -march=native ... (znver4)"
  std::filesystem::path folder() const;         ///< where the compiled kernels lie
  std::filesystem::path sourcesFolder() const;  ///< the Slang sources in use
  Statistics statistics() const;                ///< since this object was made

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Static check of a SPIR-V module: one line a violation (none is good). Every OpFAdd, OpFSub, OpFMul, OpFDiv carries
/// NoContraction; no OpDot, matrix product, FMix or Fma.
std::vector<std::string> checkSpirv(const std::filesystem::path& module);

}  // namespace tessera
