// Kernels as text for other machines: what slangc writes of a stage in another language.
#pragma once

#include <tessera/device.h>
#include <tessera/kernel-cache.h>

#include <string>
#include <vector>

namespace tessera::kernels {

struct EmitTarget {
  std::string name;       ///< slangc's name for it
  std::string extension;  ///< of its files
  Route route;            ///< whose kernels are written: kCpp has a group in one thread, the others a lane in one
  DeviceInfo device;      ///< what such a machine can do, for the plan
};
const std::vector<EmitTarget>& emitTargets();
/// Throws kUsage, naming those there are.
const EmitTarget& emitTarget(std::string_view name);

struct Emitted {
  std::string stage;
  std::string bytes;       ///< the file; empty where the target cannot take the stage
  std::string complaint;   ///< then the compiler's first error
  std::string reflection;  ///< slangc's JSON: parameters and where they go
};
Emitted emitKernel(KernelCache& cache, const KernelRequest& request, const EmitTarget& target);

}  // namespace tessera::kernels
