#include "variants.h"

#include <algorithm>
#include <set>

#include "host/error.h"

namespace tessera {
namespace {

/// An axis that only matters under a value of another one.
struct Condition {
  const char *axis, *on, *value;
};
constexpr Condition kConditions[] = {{"capacity", "binning", "queue"}, {"overflow", "binning", "queue"}};

bool isRead(const std::string& axis, const Variant& variant) {
  if (axis == "tile" && variant.get("binning") == "none") return false;
  return std::ranges::all_of(kConditions,
                             [&](const Condition& c) { return axis != c.axis || variant.get(c.on) == c.value; });
}

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
  for (const Axis& axis : axes()) {
    const bool planners = axis.name == "clip" || axis.name == "projection", places = axis.name == "route",
               output = axis.name == "counters";
    if (!planners && !places && !output && losslessValues(axis).size() > 1) names.push_back(axis.name);
  }
  return names;
}

std::vector<Variant> combinations(const std::vector<std::string>& names, const DeviceInfo& device) {
  std::vector<Variant> all{Variant{}};
  for (const std::string& name : names) {
    std::vector<Variant> next;
    for (const Variant& variant : all)
      for (const std::string& value :
           isRead(name, variant) ? losslessValues(axis(name)) : std::vector<std::string>{""}) {
        next.push_back(variant);
        if (!value.empty()) next.back().set(name, value);
      }
    all = std::move(next);
  }
  std::erase_if(all, [&](const Variant& v) { return resolved(v, device).empty(); });
  return all;
}

std::vector<Variant> rasterPaths(const DeviceInfo& device) {
  std::vector<std::string> names;
  for (const std::string& name : implementationAxes()) {
    const auto& stages = axis(name).stages;
    const bool raster = std::ranges::any_of(stages, [](const std::string& s) { return s.starts_with("raster"); });
    if (raster || name == "binning") names.push_back(name);
  }
  return combinations(names, device);
}

std::vector<Variant> eachAlone(const Variant& base, const DeviceInfo& device) {
  std::vector<Variant> all;
  std::set<std::string> seen{""};
  const auto add = [&](const Variant& variant) {
    if (seen.insert(resolved(variant, device)).second) all.push_back(variant);
  };
  for (const Variant& binning : combinations({"binning"}, device)) {
    const Variant path = joined(base, binning);
    add(path);
    for (const std::string& name : implementationAxes())
      for (const std::string& value : losslessValues(axis(name)))
        if (!path.has(name) && isRead(name, binning) && !value.empty()) add(joined(path, {{name, value}}));
  }
  return all;
}

Variant joined(Variant variant, const Variant& more) {
  for (const auto& [name, value] : more.values()) variant.set(name, value);
  return variant;
}

}  // namespace tessera
