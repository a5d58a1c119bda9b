// Scene and variant -> the passes and switches that are needed, and why each other one is left out.
#pragma once

#include <tessera/device.h>
#include <tessera/scene.h>
#include <tessera/variant.h>

#include <string>
#include <vector>

namespace tessera {

/// One thing that a frame may do, and whether this one does it.
struct PlanEntry {
  std::string pass;  ///< a pass or a switch of one
  bool kept = true;  ///< whether the frame does it
  std::string why;  ///< one line
};

/// What a frame of this scene, variant and device runs.
struct Plan {
  std::vector<PlanEntry> entries;  ///< in pipeline order
  Variant resolved;                ///< a value for every axis
  bool transform = true;           ///< positions are taken to clip space; else they are given in clip space
  bool clip = true;                ///< triangles are tried against the clip planes
  bool perspective = true;         ///< positions are divided by w
  bool binned = true;              ///< pieces are sorted into tiles
  bool clear = true;               ///< the visibility buffer is cleared first
  bool payload = false;            ///< a colour a triangle is made for the commit
  bool resolve = false;            ///< the commit's words become depth and ids
  bool shade = false;              ///< pixels get colours
  bool attribute = false;          ///< the attribute is interpolated
};

/// Makes the plan. Throws kUnsupported (device) or kUsage (axes that do not go together), with the reason and what
/// would work.
Plan makePlan(const Scene& scene, const Variant& variant, const DeviceInfo& device);

}  // namespace tessera
