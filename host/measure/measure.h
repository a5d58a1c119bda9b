// What render and parity have in common: kernels compiled ahead, frames rendered and timed, all of it kept for a row.
#pragma once

#include <tessera/kernel-cache.h>
#include <tessera/plan.h>

#include <functional>
#include <vector>

#include "host/measure/row.h"

namespace tessera::measure {

/// Prints what a user would not expect of a scene as warnings, each line once a process.
void printNotes(const Scene& scene);

/// Compiles what the plans need, all kernels at once on all cores, with progress; a user's kernel whose SPIR-V is not
/// exact gets a line on stderr.
void compileKernels(KernelCache& kernels, const std::vector<Plan>& plans);

/// A run that has not rendered yet: scene, variant as it was asked for, device and tools.
Run beginRun(const Scene& scene, const Variant& variant, const Device& device, const KernelCache& kernels);

/// Renders run.scene under run.variant and fills `run`: one frame that warms up (buffers grow, drivers compile), which
/// is returned, then `repeat` timed ones; `progress` hears how many frames are done.
Frame measureRun(Run& run, Rasterizer& rasterizer, KernelCache& kernels, unsigned repeat,
                 const std::function<void(unsigned)>& progress = {});

/// What a frame tells of its own error, in `run`: hits under commit=count, the attribute's error from its exact value.
void measureError(Run& run, const Framebuffer& image);

/// A table's name for the whole frame's time, which ends with the visibility buffer.
std::string frameLabel(const Run& run);

}  // namespace tessera::measure
