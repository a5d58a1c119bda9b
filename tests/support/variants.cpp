#include "variants.h"

#include <tessera/error.h>

#include <algorithm>
#include <set>

#include "tests/support/covering.h"

namespace tessera::test {
namespace {

/// What the planner makes of a variant on an empty scene; "" where it refuses it.
std::string resolved(const Variant& variant, const DeviceInfo& device) {
  try {
    return makePlan(Scene{}, variant, device).resolved.text();
  } catch (const Error&) {
    return "";
  }
}

}  // namespace

std::vector<std::string> losslessValues(const Axis& axis) {
  if (axis.values.empty()) return {"", std::to_string(axis.least), std::to_string(std::min(axis.least * 8, axis.most))};
  std::vector<std::string> names;
  for (const AxisValue& value : axis.values)
    // overflow=error loses nothing either: the frame fails.
    if (value.kind == AxisKind::kImplementation && !(axis.name == "overflow" && value.name == "error"))
      names.push_back(value.name);
  return names;
}

std::vector<std::string> implementationAxes() {
  std::vector<std::string> names;
  for (const Axis& axis : allAxes()) {
    const bool planners = axis.name == "clip" || axis.name == "projection", places = axis.name == "route",
               output = axis.name == "counters";
    if (!planners && !places && !output && losslessValues(axis).size() > 1) names.push_back(axis.name);
  }
  return names;
}

bool isAccepted(const Variant& variant, const DeviceInfo& device) { return !resolved(variant, device).empty(); }

std::vector<Variant> combinations(const std::vector<std::string>& names, const DeviceInfo& device) {
  std::vector<Variant> all{Variant{}};
  for (const std::string& name : names) {
    std::vector<Variant> next;
    for (const Variant& variant : all) {
      const std::size_t before = next.size();
      for (const std::string& value : losslessValues(axis(name))) {
        const Variant more = value.empty() ? variant : axes::joined(variant, {{name, value}});
        if (isAccepted(more, device)) next.push_back(more);
      }
      if (next.size() == before) next.push_back(variant);
    }
    all = std::move(next);
  }
  return all;
}

std::vector<Variant> rasterPaths(const DeviceInfo& device) {
  std::vector<AxisValues> all;
  for (const std::string& name : implementationAxes()) {
    all.emplace_back(name, losslessValues(axis(name)));
    std::erase(all.back().second, "");
  }
  return covering({}, all, 2, [&](const Variant& variant) { return isAccepted(variant, device); });
}

std::vector<Variant> eachAlone(const Variant& base, const DeviceInfo& device) {
  std::vector<Variant> all;
  std::set<std::string> seen{""};
  const auto add = [&](const Variant& variant) {
    if (seen.insert(resolved(variant, device)).second) all.push_back(variant);
  };
  add(base);
  for (const std::string& name : implementationAxes())
    for (const std::string& value : losslessValues(axis(name)))
      if (!base.has(name) && !value.empty()) add(axes::joined(base, {{name, value}}));
  return all;
}

}  // namespace tessera::test
