#include "variants.h"

#include <algorithm>
#include <set>

#include "host/error.h"

namespace tessera {
namespace {

/// What the planner makes of a variant on an empty scene; "" where it refuses it.
std::string resolved(const Variant& variant, const DeviceInfo& device) {
  try {
    return makePlan(Scene{}, variant, device).resolved.text();
  } catch (const Error&) {
    return "";
  }
}

using Pair = std::pair<std::string, std::string>;  // two "axis=value", the earlier axis first

/// Pairs of `variant` that are in `wanted`.
std::vector<Pair> pairsIn(const Variant& variant, const std::vector<std::string>& names, const std::set<Pair>& wanted) {
  std::vector<Pair> found;
  for (std::size_t a = 0; a < names.size(); ++a)
    for (std::size_t b = a + 1; b < names.size(); ++b) {
      const Pair pair{names[a] + "=" + variant.get(names[a]), names[b] + "=" + variant.get(names[b])};
      if (wanted.contains(pair)) found.push_back(pair);
    }
  return found;
}

std::set<Pair> acceptedPairs(const std::vector<std::string>& names, const DeviceInfo& device) {
  std::set<Pair> pairs;
  for (std::size_t a = 0; a < names.size(); ++a)
    for (std::size_t b = a + 1; b < names.size(); ++b)
      for (const std::string& first : losslessValues(axis(names[a])))
        for (const std::string& second : losslessValues(axis(names[b])))
          if (!first.empty() && !second.empty() &&
              isAccepted({{names[a], first}, {names[b], second}}, device))
            pairs.emplace(names[a] + "=" + first, names[b] + "=" + second);
  return pairs;
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

bool isAccepted(const Variant& variant, const DeviceInfo& device) { return !resolved(variant, device).empty(); }

std::vector<Variant> combinations(const std::vector<std::string>& names, const DeviceInfo& device) {
  std::vector<Variant> all{Variant{}};
  for (const std::string& name : names) {
    std::vector<Variant> next;
    for (const Variant& variant : all) {
      const std::size_t before = next.size();
      for (const std::string& value : losslessValues(axis(name))) {
        const Variant more = value.empty() ? variant : joined(variant, {{name, value}});
        if (isAccepted(more, device)) next.push_back(more);
      }
      if (next.size() == before) next.push_back(variant);
    }
    all = std::move(next);
  }
  return all;
}

std::vector<Variant> rasterPaths(const DeviceInfo& device) {
  const std::vector<std::string> names = implementationAxes();
  std::set<Pair> wanted = acceptedPairs(names, device);
  std::vector<Variant> paths;
  while (!wanted.empty()) {
    // A pair that is not covered yet, then for each other axis the value that covers most with what there is.
    Variant path;
    path.set(wanted.begin()->first);
    path.set(wanted.begin()->second);
    for (const std::string& name : names) {
      if (path.has(name)) continue;
      std::size_t most = 0;
      Variant best = path;
      for (const std::string& value : losslessValues(axis(name))) {
        if (value.empty()) continue;
        const Variant more = joined(path, {{name, value}});
        const std::size_t covered = pairsIn(more, names, wanted).size();
        if ((covered > most || !best.has(name)) && isAccepted(more, device)) best = more, most = covered;
      }
      path = best;
    }
    for (const Pair& pair : pairsIn(path, names, wanted)) wanted.erase(pair);
    paths.push_back(path);
  }
  return paths;
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
      if (!base.has(name) && !value.empty()) add(joined(base, {{name, value}}));
  return all;
}

Variant joined(Variant variant, const Variant& more) {
  for (const auto& [name, value] : more.values()) variant.set(name, value);
  return variant;
}

}  // namespace tessera
