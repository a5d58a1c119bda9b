// The Vulkan instance, its adapters, and which of them can run us. Shared by the compute device and the draw baseline.
#pragma once

#include <tessera/error.h>
#include <tessera/vulkan-device.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>
#include <vulkan/vulkan_raii.hpp>

namespace tessera::devices::vulkan {

constexpr std::uint32_t kApiVersion = VK_API_VERSION_1_2;

/// An adapter, what it can do, and the queue family that we would use. `whyNot` is empty when it is usable.
struct Adapter {
  vk::raii::PhysicalDevice physical;
  vk::PhysicalDeviceProperties properties;
  vk::PhysicalDeviceDriverProperties driver;
  vk::PhysicalDeviceFeatures features;
  vk::PhysicalDeviceVulkan12Features features12;
  std::uint32_t queueFamily = 0;
  std::uint32_t timestampBits = 0;
  std::string whyNot;

  std::string name() const { return properties.deviceName.data(); }
  std::string driverText() const;      ///< "llvmpipe Mesa 22.3.6 (LLVM 15.0.6)"
  std::string apiVersionText() const;  ///< "1.3.230"
  bool isSoftware() const;             ///< lavapipe or SwiftShader
};

class Instance {
 public:
  /// Throws kUsage when there is no Vulkan loader or driver, or validation is asked for and its layer is not installed.
  Instance(bool validation, std::function<void(const std::string&)> onMessage);
  /// Adapters in the loader's order, whose queue family has all of `queueFlags` and timestamps.
  std::vector<Adapter> adapters(vk::QueueFlags queueFlags = vk::QueueFlagBits::eCompute) const;
  /// What the loader complained about when it looked for drivers; there may be adapters all the same.
  const std::vector<std::string>& complaints() const { return complaints_; }

 private:
  std::vector<std::string> complaints_;  // before instance_, whose making fills it
  vk::raii::Context context_;
  // On the heap: the messenger keeps a pointer to it.
  std::unique_ptr<std::function<void(const std::string&)>> onMessage_;
  vk::raii::Instance instance_;
  vk::raii::DebugUtilsMessengerEXT messenger_ = nullptr;
};

/// The adapter that VulkanOptions::select names; see there. `complaints` are the instance's, for the message.
Adapter selectAdapter(std::vector<Adapter> adapters, const std::string& select,
                      const std::vector<std::string>& complaints);

/// The complaints, and the variables that name files which are not there.
std::vector<std::string> withMissingFiles(std::vector<std::string> complaints);

/// Runs `work`; a Vulkan failure in it leaves as Error, one line that starts with `what`.
template <class Work>
auto translated(const std::string& what, Work&& work) {
  try {
    return work();
  } catch (const vk::SystemError& error) {
    fail(what + ": " + error.what());
  }
}

}  // namespace tessera::devices::vulkan
