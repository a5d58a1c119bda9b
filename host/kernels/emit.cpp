#include "host/kernels/emit.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tessera/error.h>

#include <algorithm>

#include "host/axes/routes.h"
#include "host/kernels/slang-compiler.h"
#include "host/kernels/slang-sources.h"
#include "host/support/files.h"
#include "host/support/suggest.h"

namespace tessera::kernels {
namespace {

/// A machine whose kernels are made from those of a route, or of another with a binary of the same kind.
DeviceInfo machine(const char* name, Route route = Route::kSpirv) {
  DeviceInfo device;
  device.name = name;
  for (const axes::RouteInfo& other : axes::routes())
    if (other.spirv == axes::routeInfo(route).spirv) device.routes.push_back(other.name);
  if (axes::routeInfo(route).oneThreadGroups) device.maxGroupBytes = axes::kThreadGroupBytes;
  return device;
}

/// WGSL has 32-bit scalars only, and a WebGPU device need not give a group more than 16 KiB
/// (maxComputeWorkgroupStorageSize).
DeviceInfo webgpu() {
  DeviceInfo device = machine("WGSL");
  device.int64 = device.float64 = device.atomicMin64 = device.groupAtomicMin64 = false;
  device.maxGroupBytes = 16384;
  return device;
}

}  // namespace

const std::vector<EmitTarget>& emitTargets() {
  static const std::vector<EmitTarget> list{{"spirv", "spv", Route::kSpirv, machine("SPIR-V")},
                                            {"glsl", "comp", Route::kGlsl, machine("GLSL")},
                                            {"cpp", "cpp", Route::kCpp, machine("C++", Route::kCpp)},
                                            {"wgsl", "wgsl", Route::kSpirv, webgpu()},
                                            {"hlsl", "hlsl", Route::kSpirv, machine("HLSL")},
                                            {"metal", "metal", Route::kSpirv, machine("Metal")},
                                            {"cuda", "cu", Route::kSpirv, machine("CUDA")}};
  return list;
}

const EmitTarget& emitTarget(std::string_view name) {
  const auto found = std::ranges::find(emitTargets(), name, &EmitTarget::name);
  if (found != emitTargets().end()) return *found;
  failUsage(fmt::format("--emit {}: no such target; {}", name,
                        support::whatThereIs(name, support::namesOf(emitTargets(), &EmitTarget::name))));
}

Emitted emitKernel(KernelCache& cache, const KernelRequest& request, const EmitTarget& target) {
  Emitted emitted{request.stage, "", "", ""};
  try {
    Written written = writtenBySlang(request, target.name, cache.slangc(), cache.sourcesFolder());
    emitted.bytes = target.name == "spirv" ? readText(cache.get(request).binary)  // the very module that runs
                                           : std::move(written.text);
    emitted.reflection = std::move(written.reflection);
  } catch (const support::WriteError&) {
    throw;
  } catch (const Error& error) {
    emitted.complaint = error.what();
  }
  return emitted;
}

}  // namespace tessera::kernels
