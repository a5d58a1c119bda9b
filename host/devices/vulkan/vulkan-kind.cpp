#include <tessera/vulkan-device.h>

#include <string>

#include "host/devices/kinds.h"

namespace tessera::devices {
namespace {

FoundDevices find() {
  VulkanAdapters here = listVulkanAdapters();
  FoundDevices found{.devices = {}, .notes = std::move(here.notes)};
  for (VulkanAdapter& adapter : here.adapters)
    found.devices.push_back(
        {std::to_string(adapter.index), std::move(adapter.name), std::move(adapter.driver), std::move(adapter.whyNot)});
  return found;
}

std::unique_ptr<Device> open(const std::string& select, const DeviceOptions& options) {
  VulkanOptions vulkan;
  vulkan.select = select;
  vulkan.validation = options.validation;
  vulkan.boundsChecks = options.boundsChecks;
  return makeVulkanDevice(vulkan);
}

}  // namespace

DeviceKind vulkanKind() {
  return {.name = "vulkan",
          .title = "Vulkan",
          .meaning = "the first of Vulkan's",
          .nickname = "gpu",
          .routes = {"spirv", "glsl"},
          .selects = true,
          .checksBounds = true,
          .find = find,
          .open = open};
}

}  // namespace tessera::devices
