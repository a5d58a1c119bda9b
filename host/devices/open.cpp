#include "host/devices/open.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <tessera/cpu-device.h>
#include <tessera/error.h>
#include <tessera/vulkan-device.h>

#include "host/support/suggest.h"
#include "host/support/text.h"

namespace tessera {
namespace {

[[noreturn]] void failDevice(const std::string& name) {
  std::vector<std::string> names{"cpu"}, known{"cpu"};
  std::string part;
  for (const VulkanAdapter& adapter : listVulkanAdapters().adapters) {
    names.push_back(fmt::format("vulkan:{}", adapter.index));
    known.push_back(fmt::format("vulkan:{} ({})", adapter.index, adapter.name));
    if (lowerCase(name) == "gpu") part = "vulkan";
    if (!name.empty() && lowerCase(adapter.name).find(lowerCase(name)) != std::string::npos) part = "vulkan:" + name;
  }
  if (part.empty()) part = nearest(name, names);
  failUsage(fmt::format("--device {}: no such device; {}there {} {}", name,
                        part.empty() ? "" : fmt::format("did you mean {}? Otherwise ", part),
                        known.size() == 1 ? "is" : "are", fmt::join(known, ", ")));
}

}  // namespace

std::unique_ptr<Device> openDevice(const std::string& name, unsigned threads, bool boundsChecks) {
  if (name == "cpu") return makeCpuDevice({.threads = threads});
  VulkanOptions vulkan;
  vulkan.boundsChecks = boundsChecks;
  if (name.starts_with("vulkan:")) vulkan.select = name.substr(7);
  if (name != "vulkan" && vulkan.select.empty()) failDevice(name);
#ifdef TESSERA_VALIDATION
  vulkan.validation = true;
#endif
  return makeVulkanDevice(vulkan);
}

std::vector<std::string> presentDevices() {
  std::vector<std::string> names{"cpu"};
  for (const auto& adapter : listVulkanAdapters().adapters)
    if (adapter.whyNot.empty()) names.push_back(fmt::format("vulkan:{}", adapter.index));
  return names;
}

Route routeOf(const DeviceInfo& device, const Variant& variant) {
  if (device.api == "cpu") return Route::kCpp;
  return variant.get("route", "spirv") == "glsl" ? Route::kGlsl : Route::kSpirv;
}

}  // namespace tessera
