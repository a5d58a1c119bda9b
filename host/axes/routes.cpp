#include "host/axes/routes.h"

#include <fmt/format.h>
#include <tessera/error.h>

#include <algorithm>

#include "host/support/suggest.h"

namespace tessera {
namespace {

bool isRoute(std::string_view name) { return std::ranges::count(routes(), name, &RouteInfo::name) > 0; }

unsigned needsOf(const AxisValue& value) { return value.features & (kNeedsCpu | kNeedsVulkan); }

}  // namespace

const std::vector<RouteInfo>& routes() {
  static const std::vector<RouteInfo> list{
      {.route = Route::kCpp,
       .name = "cpp",
       .meaning = "Slang to C++",
       .needs = kNeedsCpu,
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
       .needs = kNeedsVulkan,
       .devices = "Vulkan devices",
       .slangFlags = {"-target", "spirv", "-O1", "-fp-mode", "precise"},
       .written = "kernel.spv",
       .binary = "kernel.spv",
       .spirv = true,
       .takesGlsl = true},
      {.route = Route::kGlsl,
       .name = "glsl",
       .meaning = "Slang to GLSL to glslang to SPIR-V",
       .needs = kNeedsVulkan,
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
  failUsage(fmt::format("route {}: no such route; {}", name, whatThereIs(name, namesOf(routes(), &RouteInfo::name))));
}

Axis routeAxis() {
  Axis axis{.name = "route",
            .meaning = "how the kernels reach the machine",
            .source = "Slang user guide, chapter on targets",
            .unset = "cpp on the CPU device, spirv on a Vulkan device"};
  for (const RouteInfo& route : routes())
    axis.values.push_back({route.name, route.meaning, "", AxisKind::kImplementation, route.needs});
  return axis;
}

bool fulfils(const std::vector<std::string>& taken, const AxisValue& value) {
  if (needsOf(value) == 0) return true;
  if (isRoute(value.name)) return std::ranges::count(taken, value.name) > 0;
  return std::ranges::any_of(
      taken, [&](const std::string& name) { return (routeNamed(name).needs & needsOf(value)) == needsOf(value); });
}

std::string devicesFor(const AxisValue& value) {
  const auto route =
      std::ranges::find_if(routes(), [&](const RouteInfo& r) { return (r.needs & needsOf(value)) == needsOf(value); });
  return route->devices;
}

}  // namespace tessera
