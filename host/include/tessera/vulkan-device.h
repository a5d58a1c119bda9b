// Vulkan 1.2 or later, through Vulkan-Hpp RAII.
#pragma once

#include <tessera/device.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tessera {

struct VulkanAdapter {
  unsigned index;
  std::string name, driver, apiVersion;
  std::string whyNot;  ///< empty when usable
};
struct VulkanAdapters {
  std::vector<VulkanAdapter> adapters;
  /// What kept a driver from loading, a line each: variables of the environment by name, the loader's own words. There
  /// is one where there are no adapters.
  std::vector<std::string> notes;
};
VulkanAdapters listVulkanAdapters();  ///< never throws for a missing loader or driver

struct VulkanOptions {
  /// "" a GPU before a software driver, "N" by index, else part of the name; kUsage if there is none.
  std::string select;
  bool validation = false;  ///< load VK_LAYER_KHRONOS_validation; kUsage if it is not installed
  /// Takes validation messages (warnings and errors); empty: they go to standard error.
  std::function<void(const std::string&)> onMessage;
  /// Kernels with bounds checks: dispatch() waits for the kernel and throws as failOutOfBounds() of kernel-fault.h
  /// does.
  bool boundsChecks = false;
  bool staged = false;  ///< copy through a staging buffer even where memory is mapped (tests)
};
std::unique_ptr<Device> makeVulkanDevice(const VulkanOptions& options = {});

}  // namespace tessera
