// Users' kernels are native code: each runs one frame in a build with bounds checks before any frame that counts.
#pragma once

#include <tessera/kernel-cache.h>
#include <tessera/rasterizer.h>
#include <tessera/scene.h>

#include <memory>

namespace tessera {

/// The frame is rendered on the CPU device, whatever device the kernels are for: a GPU has no such checks. GLSL, and
/// kernels whose groups need more than one thread, do not run there and are not checked.
class KernelCheck {
 public:
  /// Compiles all stages with checks, ours too: what a user's kernel wrote may be what ours stumbles over.
  KernelCheck(const Scene& scene, const Variant& variant, const KernelFiles& files);
  ~KernelCheck();

  /// Renders the frame. Throws kUsage for an index out of range, with kernel, file, index and buffer. After ten seconds
  /// a line on stderr says which kernel runs.
  void run();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Compiles and runs; nothing where there are no files. Faults of kernels that are no index, such as a division by
/// zero, end the process with a line from then on.
void checkUserKernels(const Scene& scene, const Variant& variant, const KernelFiles& files);

}  // namespace tessera
