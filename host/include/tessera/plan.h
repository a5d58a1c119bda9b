// Scene and variant -> the stages and switches that are needed, and why each other one is left out.
#pragma once

#include <tessera/device.h>
#include <tessera/scene.h>
#include <tessera/variant.h>

#include <string>
#include <string_view>
#include <vector>

namespace tessera {

/// What a plan says about one stage, or about a switch of a stage.
struct PlanEntry {
  std::string pass;  ///< the stage's name, or "STAGE: switch"
  bool kept = true;  ///< whether a frame does it
  std::string why;  ///< one line
};

/// A plan describes the frames of one scene under one variant on one kind of device.
struct Plan {
  std::vector<PlanEntry> entries;   ///< in pipeline order
  std::vector<std::string> stages;  ///< that a frame may dispatch, retries among them, in pipeline order
  std::vector<std::string> streams; ///< of the scene, by name: a kernel may bind each as a buffer of floats
  Variant resolved;                 ///< a value for every axis

  /// Whether a frame may dispatch the stage.
  bool runs(std::string_view stage) const;
};

/// Throws kUnsupported for what the device cannot do and kUsage for axes that do not go together or do not go with the
/// scene, with the reason and what would work.
Plan makePlan(const Scene& scene, const Variant& variant, const DeviceInfo& device);

}  // namespace tessera
