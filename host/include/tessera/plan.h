// The plan of a frame: which stages and switches a scene and a variant need, and why each other stage or switch is left
// out.
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
  bool kept = true;  ///< whether a frame runs the stage, or has the switch on
  std::string why;   ///< the reason, in one line
};

/// A plan describes the frames of one scene under one variant on one kind of device.
struct Plan {
  std::vector<PlanEntry> entries;   ///< in pipeline order
  std::vector<std::string> stages;  ///< stages that a frame may dispatch, with the stages of retries, in pipeline order
  std::vector<std::string> streams;  ///< names of the scene's streams; a kernel may bind each as a buffer of floats
  Variant resolved;                  ///< a value for every axis

  /// Whether a frame may dispatch the stage.
  bool runs(std::string_view stage) const;
};

/// Makes the plan of a frame. Throws kUnsupported for what the device cannot do, and kUsage for axes that do not go
/// together or do not go with the scene. The message says the reason, and what would work.
Plan makePlan(const Scene& scene, const Variant& variant, const DeviceInfo& device);

}  // namespace tessera
