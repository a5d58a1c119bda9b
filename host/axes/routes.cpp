#include "host/axes/routes.h"

#include <fmt/format.h>
#include <tessera/error.h>

#include <algorithm>

#include "host/support/suggest.h"

namespace tessera::axes {
namespace {

/// Whether the value is one of the axis `route`.
bool isRoute(const AxisValue& value) { return std::ranges::count(routes(), value.name, &RouteInfo::name) > 0; }

bool serves(const RouteInfo& route, const AxisValue& value) {
  return isRoute(value) ? route.name == value.name : !value.needs.oneThreadGroups || route.oneThreadGroups;
}

}  // namespace

const std::vector<RouteInfo>& routes() {
  static const std::vector<RouteInfo> list{
      {.route = Route::kCpp,
       .name = "cpp",
       .meaning = "Slang to C++",
       .devices = "the CPU device",
       .slangFlags = {"-target", "cpp", "-DTESSERA_CPP", "-fp-mode", "precise", "-line-directive-mode", "none"},
       .written = "slang.cpp",
       .then = SecondCompiler::kCxx,
       .binary = "kernel.so",
       .oneThreadGroups = true,
       .compiledChecks = true},
      {.route = Route::kSpirv,
       .name = "spirv",
       .meaning = "Slang to SPIR-V",
       .devices = "Vulkan devices",
       .slangFlags = {"-target", "spirv", "-O1", "-fp-mode", "precise"},
       .written = "kernel.spv",
       .binary = "kernel.spv",
       .spirv = true,
       .takesGlsl = true},
      {.route = Route::kGlsl,
       .name = "glsl",
       .meaning = "Slang to GLSL to glslang to SPIR-V",
       .devices = "Vulkan devices",
       .slangFlags = {"-target", "glsl", "-fp-mode", "precise", "-line-directive-mode", "none"},
       .written = "kernel.comp",
       .then = SecondCompiler::kGlslang,
       .binary = "kernel.spv",
       .spirv = true,
       .takesGlsl = true}};
  return list;
}

const RouteInfo& routeInfo(Route route) { return *std::ranges::find(routes(), route, &RouteInfo::route); }

const RouteInfo& routeNamed(std::string_view name) {
  const auto found = std::ranges::find(routes(), name, &RouteInfo::name);
  if (found != routes().end()) return *found;
  failUsage(fmt::format("route {}: no such route; {}", name,
                        support::whatThereIs(name, support::namesOf(routes(), &RouteInfo::name))));
}

Axis routeAxis() {
  Axis axis{.name = "route",
            .meaning = "how the kernels reach the machine",
            .source = "Slang user guide, chapter on targets",
            .unset = "cpp on the CPU device, spirv on a Vulkan device"};
  for (const RouteInfo& route : routes())
    axis.values.push_back({route.name, route.meaning, "", AxisKind::kImplementation});
  return axis;
}

bool fulfils(const std::vector<std::string>& taken, const AxisValue& value) {
  if (!isRoute(value) && !value.needs.oneThreadGroups) return true;
  return std::ranges::any_of(taken, [&](const std::string& name) { return serves(routeNamed(name), value); });
}

std::string devicesFor(const AxisValue& value) {
  return std::ranges::find_if(routes(), [&](const RouteInfo& r) { return serves(r, value); })->devices;
}

}  // namespace tessera::axes
