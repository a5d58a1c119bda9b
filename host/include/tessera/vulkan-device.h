// Vulkan 1.2 or later, through Vulkan-Hpp RAII.
#pragma once

#include <tessera/device.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tessera {

/// A device that a Vulkan driver offers.
struct VulkanAdapter {
  unsigned index;          ///< place in the loader's order, from 0
  std::string name;        ///< e.g. "llvmpipe (LLVM 15.0.6, 256 bits)"
  std::string driver;      ///< the driver's name and version
  std::string apiVersion;  ///< version of Vulkan, e.g. "1.3.230"
  std::string whyNot;      ///< why it cannot be used, one line; empty when it is usable
};
/// What Vulkan has on this machine.
struct VulkanAdapters {
  std::vector<VulkanAdapter> adapters;  ///< in the loader's order
  /// What kept a driver from loading, a line each: variables of the environment by name, the loader's own words. There
  /// is one where there are no adapters.
  std::vector<std::string> notes;
};
/// Lists the adapters. Never throws for a missing loader or driver.
VulkanAdapters listVulkanAdapters();

/// Which adapter is opened, and how.
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
/// Opens a Vulkan device, which takes the routes "spirv" and "glsl". Throws kUsage where there is no such adapter, with
/// what kept drivers from loading.
std::unique_ptr<Device> makeVulkanDevice(const VulkanOptions& options = {});

}  // namespace tessera
