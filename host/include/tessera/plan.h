// Scene and variant -> the passes and switches that are needed, and why each other one is left out.
#pragma once

#include <tessera/device.h>
#include <tessera/scene.h>
#include <tessera/variant.h>

#include <string>
#include <vector>

namespace tessera {

struct PlanEntry {
  std::string pass;  ///< a pass or a switch of one
  bool kept = true;
  std::string why;  ///< one line
};

struct Plan {
  std::vector<PlanEntry> entries;  ///< in pipeline order
  Variant resolved;                ///< a value for every axis
  bool transform = true, clip = true, perspective = true, binned = true, clear = true, payload = false, resolve = false,
       shade = false, attribute = false;
};

/// Throws kUnsupported (device) or kUsage (axes that do not go together), with the reason and what would work.
Plan makePlan(const Scene& scene, const Variant& variant, const DeviceInfo& device);

}  // namespace tessera
