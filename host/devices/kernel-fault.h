// What a kernel does that it may not: an index out of range, where checks are built in, and signals, which no check
// sees.
#pragma once

#include <tessera/kernel.h>

#include <cstdint>
#include <string>

namespace tessera::devices {

/// As messages call it: "kernel shade (mine.slang)", or of one of ours "cpu: kernel shade".
std::string describe(const CompiledKernel& kernel, const std::string& api);

/// Throws kUsage for a user's kernel, which is input, and kFailure for one of ours. `what`: what the index is into, as
/// "`depth`" or "an array in it".
[[noreturn]] void failOutOfBounds(const CompiledKernel& kernel, const std::string& api, std::int64_t index,
                                  std::uint64_t count, const std::string& what);

/// From now on a signal that a kernel raises in this process (an integer division by zero, an address that is not
/// there) ends the process with one line that names the kernel, and exit code 2. Without it, it ends as signals end a
/// process.
void sayKernelFaults();

/// The kernel that runs as long as this lives, as messages call it; the text must live as long.
class RunningKernel {
 public:
  explicit RunningKernel(const char* description);
  ~RunningKernel();
  RunningKernel(const RunningKernel&) = delete;
};
/// That kernel; null: none.
const char* runningKernel();

}  // namespace tessera::devices
