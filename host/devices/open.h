// Devices by the names that people type.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <tessera/device.h>
#include <tessera/kernel.h>
#include <tessera/variant.h>

namespace tessera {

/// "cpu", "vulkan", "vulkan:N" or "vulkan:NAME"; `threads` of the CPU device, 0: all cores. Throws kUsage for a name that
/// no device has, naming those here. `boundsChecks`: of a Vulkan device, VulkanOptions; on the CPU the kernel cache has
/// them.
std::unique_ptr<Device> openDevice(const std::string& name, unsigned threads, bool boundsChecks = false);
/// "cpu" and "vulkan:N" for each usable Vulkan device here.
std::vector<std::string> presentDevices();
/// How kernels reach this device under this variant.
Route routeOf(const DeviceInfo& device, const Variant& variant);

}  // namespace tessera
