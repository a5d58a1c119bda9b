// Users' kernels are native code: each runs one frame in a build with bounds checks before any frame that counts.
#pragma once

#include <tessera/kernel-cache.h>
#include <tessera/rasterizer.h>
#include <tessera/scene.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tessera::measure {

/// What the kernels will run in: a device by the name that openDevice() takes, and the variant as asked for there.
struct KernelRun {
  std::string device;
  Variant variant;
};

/// A frame on the first kind of devices whose kernels have compiled checks (the CPU device), of those kernels that run
/// there, whatever device they are for: there an integer division by zero is seen, too. Then a frame for each run on a
/// device that checks indices itself (a Vulkan device), there, of all kernels. A run that its device refuses has no
/// frame: the run's own frame says why.
class KernelCheck {
 public:
  /// Compiles all stages with checks, ours too: what a user's kernel wrote may be what ours stumbles over.
  KernelCheck(const Scene& scene, const KernelFiles& files, const std::vector<KernelRun>& runs);
  ~KernelCheck();

  /// Renders the frames, each within `frame`. Throws kUsage for an index out of range, with kernel, file, index and
  /// buffer. After ten seconds of a frame a line on stderr says which kernel runs.
  void run(const std::function<void(const std::function<void()>&)>& frame);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Compiles and runs; nothing where there are no files. Faults of kernels that are no index, such as a division by
/// zero, end the process with a line from then on.
void checkUserKernels(const Scene& scene, const KernelFiles& files, const std::vector<KernelRun>& runs);

}  // namespace tessera::measure
