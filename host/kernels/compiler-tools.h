// The programs that kernels are compiled with: which there are, what they call themselves, and whether they will do.
#pragma once

#include <tessera/kernel-cache.h>

#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <string>

namespace tessera::kernels {

/// Answers about programs, kept in a file of the cache folder by the program's path, size and time of change, so that a
/// warm start runs none. A folder that cannot be written costs the memory, nothing else. Thread-safe.
class ToolMemory {
 public:
  explicit ToolMemory(const std::filesystem::path& folder);
  /// The answer to `question` about `program`; `ask` is called if it is not known for this very file.
  std::string recall(const std::string& question, const std::filesystem::path& program,
                     const std::function<std::string()>& ask);

 private:
  std::filesystem::path file_;
  std::mutex mutex_;
  std::map<std::string, std::string> answers_;
};

/// $SLANGC if set; else the first slangc in PATH that will do; else the `pinned` one (see home.h). One will do if
/// it compiles a small module at -O1 (which takes its optimiser: Mesa refuses some of what slangc writes without one)
/// and the result passes checkSpirv(). Throws kUsage where $SLANGC will not do, and where there is none.
ToolInfo chooseSlangc(ToolMemory& memory, const std::filesystem::path& pinned);

struct CxxInfo {
  std::filesystem::path path;
  std::string version;       ///< "g++ 12.2.0"
  std::string target;        ///< what -march=native stands for, e.g. "znver4"
  std::string targetMacros;  ///< predefined for that target; in the key, since hypervisors mask features of a processor
};
/// $TESSERA_CXX if set, else the C++ compiler that this build was made with. Throws kUsage if it is not there.
CxxInfo resolveCxx(ToolMemory& memory);

/// glslangValidator from PATH. Throws kUsage if there is none.
ToolInfo resolveGlslang(ToolMemory& memory);

/// What DeviceInfo::driver says for the CPU: the compiler and the target that kernels are built for. Without a compiler
/// it says so: the first kernel is refused then.
std::string cpuDriverText();

}  // namespace tessera::kernels
