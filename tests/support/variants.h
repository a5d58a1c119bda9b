// Variants to test, made from allAxes(): an axis or value that is added there is tested from then on.
#pragma once

#include <tessera/plan.h>
#include <tessera/variant.h>

#include <string>
#include <vector>

#include "host/axes/settings.h"  // joined()

namespace tessera::test {

/// Names of the values of an axis that may change no bit. Of an axis of integers, a few from its least one on; "" is
/// the plan's choice.
std::vector<std::string> losslessValues(const Axis& axis);
/// Axes with two or more lossless values that a test can set on any scene: all but those that only the planner knows to
/// set (clip, projection), the one that the machine sets (route), and the one that chooses what comes back, not how it
/// is made (counters).
std::vector<std::string> implementationAxes();
/// Whether the planner takes it for an empty scene on this device.
bool isAccepted(const Variant& variant, const DeviceInfo& device);
/// Every combination of lossless values of these axes that the planner accepts on this device, an axis that a
/// combination does not read (tile without bins, capacity without queues) being left unset.
std::vector<Variant> combinations(const std::vector<std::string>& axes, const DeviceInfo& device);
/// A covering design of strength two: variants of all implementation axes such that every pair of lossless values that
/// the planner accepts together is in one of them at least.
std::vector<Variant> rasterPaths(const DeviceInfo& device);
/// On top of `base`: the plan's choice, then each lossless value of each axis alone.
std::vector<Variant> eachAlone(const Variant& base, const DeviceInfo& device);

}  // namespace tessera::test
