// A cell's first frames: what it draws, held against the oracle, and what a row says of it beside its times.
#pragma once

#include <tessera/kernel-cache.h>
#include <tessera/rasterizer.h>

#include <functional>
#include <list>
#include <memory>
#include <stdexcept>

#include "experiments/harness/request.h"
#include "host/measure/parity-oracle.h"
#include "host/measure/row.h"

namespace tessera::harness {

/// The oracle's images of one job, each rendered once as long as there is room for it.
class Oracles {
 public:
  measure::Oracle& of(const Scene& scene, const Variant& resolved);

 private:
  struct Kept {
    const Scene* scene;
    std::string image;
    std::size_t bytes;
    std::unique_ptr<measure::Oracle> oracle;
  };
  std::list<Kept> kept_;  ///< the one used last is in front
};

/// What a check needs. `frame` renders under the time limit.
struct CheckTools {
  Device& device;  ///< of its own for each check, so that its peak of bytes is of this cell
  std::string deviceName;  ///< as it is opened by
  KernelCache& kernels;
  Oracles& oracles;
  std::filesystem::path folder;  ///< of the results
  std::function<void(const std::function<void()>&)> frame;
};

/// The results folder cannot be written, which is no fault of the cell.
struct PictureFailed : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Fills `run`, which holds scene, variant as asked for, device and tools: plan, counters, error, picture, and status
/// and message where an implementation variant differs from the oracle. Returns the seconds of a frame, kernels in
/// place. Throws Error as Rasterizer does.
double checkCell(measure::Run& run, std::size_t number, const CheckTools& tools);

/// Whether two frames of it may differ: what they are in error by is measured frame by frame.
bool variesFromRunToRun(const Variant& resolved);

/// The error of one frame of such a variant.
Difference errorOf(const Scene& scene, const Variant& resolved, const Framebuffer& image, Oracles& oracles);

}  // namespace tessera::harness
