#include "host/plan/choice.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tessera/error.h>

#include <algorithm>

#include "host/axes/routes.h"

namespace tessera::plan {

std::optional<std::string> missingNeed(const AxisValue& value, const DeviceInfo& device) {
  if (!axes::fulfils(device.routes, value))
    return fmt::format("it is for {}{}", axes::devicesFor(value), value.limits.empty() ? "" : ": " + value.limits);
  const Needs& needs = value.needs;
  if (needs.float64 && !device.float64) return device.name + " has no 64-bit floats (shaderFloat64)";
  if (needs.int64 && !device.int64) return device.name + " has no 64-bit integers (shaderInt64)";
  if (needs.atomicMin64 && !device.atomicMin64)
    return device.name + " has no 64-bit atomic min on buffers (shaderBufferInt64Atomics)";
  if (needs.groupAtomicMin64 && !device.groupAtomicMin64)
    return device.name + " has no 64-bit atomic min in group memory (shaderSharedInt64Atomics)";
  return std::nullopt;
}

Variant settable(const Variant& resolved) {
  Variant result;
  for (const auto& [name, value] : resolved.values()) {
    const bool idle = std::ranges::any_of(axisRules(), [&](const AxisRule& rule) {
      return rule.axis == name && rule.values.empty() && resolved.has(rule.other) &&
             std::ranges::count(rule.only, resolved.get(rule.other)) == 0;
    });
    if (!idle) result.set(name, value);
  }
  return result;
}

/// The rule that `value` breaks beside what was asked for and taken.
const AxisRule* Choice::broken(const std::string& axis, const std::string& value) const {
  for (const AxisRule& rule : axisRules()) {
    // A rule about an axis as such, whatever its value, is about people's settings: the plan's own do no harm.
    const bool concerns = rule.values.empty() ? asked_.has(rule.axis) : true;
    if (!concerns) continue;
    const std::string first = rule.axis == axis ? value : current(rule.axis);
    const std::string other = rule.other == axis ? value : current(rule.other);
    if ((rule.axis != axis && rule.other != axis) || first.empty() || other.empty()) continue;
    const bool applies = rule.values.empty() || std::ranges::count(rule.values, first) > 0;
    if (applies && std::ranges::count(rule.only, other) == 0) return &rule;
  }
  return nullptr;
}

bool Choice::fits(const Axis& axis, const std::string& value) const {
  if (!axis.values.empty() && missingNeed(axisValue(axis.name, value), device_)) return false;
  return broken(axis.name, value) == nullptr;
}

void Choice::refuse(const AxisRule& rule) const {
  const std::string first = current(rule.axis), other = current(rule.other);
  failUsage(fmt::format("{}={} with {}={}: {}; set {}={}", rule.axis, first, rule.other, other, rule.why, rule.other,
                        fmt::join(rule.only, " or ")));
}

std::string Choice::take(std::string_view name, const std::vector<std::string>& preferred) {
  const Axis& a = axis(name);
  std::string value = asked_.get(name);
  if (value.empty()) {
    const auto fit = std::ranges::find_if(preferred, [&](const std::string& v) { return fits(a, v); });
    value = fit == preferred.end() ? preferred.front() : *fit;  // a rule that none keeps is named below
  }
  if (!a.values.empty())
    if (const auto missing = missingNeed(axisValue(a.name, value), device_)) {
      std::vector<std::string> others;  // of its kind: what would give the image that was asked for
      for (const AxisValue& other : a.values)
        if (other.kind == axisValue(a.name, value).kind && fits(a, other.name)) others.push_back(other.name);
      failUnsupported(fmt::format("{}={}: {}; set {}={}", a.name, value, *missing, a.name, fmt::join(others, " or ")));
    }
  taken_.set(name, value);
  if (const AxisRule* rule = broken(a.name, value)) refuse(*rule);
  return value;
}

}  // namespace tessera::plan
