#include "host/devices/vulkan/instance.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <utility>

#include "host/devices/vulkan/drivers.h"
#include "host/support/terminal.h"

namespace tessera::devices::vulkan {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

VKAPI_ATTR VkBool32 VKAPI_CALL forwardMessage(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                              const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
  (*static_cast<std::function<void(const std::string&)>*>(user))(data->pMessage);
  return VK_FALSE;
}

vk::DebugUtilsMessengerCreateInfoEXT messengerInfo(void* user) {
  using Severity = vk::DebugUtilsMessageSeverityFlagBitsEXT;
  using Type = vk::DebugUtilsMessageTypeFlagBitsEXT;
  return {{}, Severity::eWarning | Severity::eError, Type::eValidation | Type::ePerformance, forwardMessage, user};
}

/// Keeps what the loader complains about while it makes an instance, in its order, each once.
VKAPI_ATTR VkBool32 VKAPI_CALL keepComplaint(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                             VkDebugUtilsMessageTypeFlagsEXT,
                                             const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
  auto& complaints = *static_cast<std::vector<std::string>*>(user);
  const std::string text = plainWords(data->pMessage);
  // Among its warnings, only a driver that it skips is worth a word.
  const bool skipped = text.find("Skipping ICD JSON") != std::string::npos;
  if (severity != VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT && !skipped) return VK_FALSE;
  if (!text.empty() && std::ranges::find(complaints, text) == complaints.end()) complaints.push_back(text);
  return VK_FALSE;
}

vk::DebugUtilsMessengerCreateInfoEXT complaintInfo(std::vector<std::string>& complaints) {
  using Severity = vk::DebugUtilsMessageSeverityFlagBitsEXT;
  return {{},
          Severity::eWarning | Severity::eError,
          vk::DebugUtilsMessageTypeFlagBitsEXT::eGeneral,
          keepComplaint,
          &complaints};
}

/// Debian keeps SwiftShader, a software driver, where the loader does not look: in chromium-common. It is added where
/// the user says nothing about drivers (loaders from 1.3.207 on read this; older ones leave it alone).
void addSwiftShader() {
  constexpr const char* kDriver = "/usr/lib/chromium/vk_swiftshader_icd.json";
  const char* const added = std::getenv("VK_ADD_DRIVER_FILES");
  if (added != nullptr && std::strcmp(added, kDriver) == 0)
    ownVariable("VK_ADD_DRIVER_FILES");  // a parent's, say a sweep's
  for (const char* said : {"VK_ICD_FILENAMES", "VK_DRIVER_FILES", "VK_ADD_DRIVER_FILES"})
    if (std::getenv(said) != nullptr) return;
  std::error_code ignored;
  if (!std::filesystem::exists(kDriver, ignored)) return;
  setenv("VK_ADD_DRIVER_FILES", kDriver, 0);
  ownVariable("VK_ADD_DRIVER_FILES");
}

vk::raii::Context makeContext() try {
  addSwiftShader();
  return vk::raii::Context();
} catch (const std::runtime_error&) {
  failUsage("no Vulkan loader (libvulkan.so.1) on this machine; Debian: libvulkan1 mesa-vulkan-drivers");
}

vk::raii::Instance makeInstance(const vk::raii::Context& context, bool validation, void* user,
                                std::vector<std::string>& complaints) try {
  const vk::ApplicationInfo application("tessera", 1, "tessera", 1, kApiVersion);
  vk::InstanceCreateInfo info({}, &application);
  const auto ears = complaintInfo(complaints);
  auto messenger = messengerInfo(user);
  messenger.setPNext(&ears);
  const std::array extensions{VK_EXT_DEBUG_UTILS_EXTENSION_NAME};
  info.setPEnabledExtensionNames(extensions).setPNext(&ears);  // the loader's own, so there without any driver
  if (validation) {
    const auto layers = context.enumerateInstanceLayerProperties();
    const auto isOurs = [](const auto& layer) { return std::strcmp(layer.layerName, kValidationLayer) == 0; };
    if (std::none_of(layers.begin(), layers.end(), isOurs))
      failUsage(driverFailure(fmt::format("{} is not installed", kValidationLayer), {}, About::kLayers));
    info.setPEnabledLayerNames(kValidationLayer).setPEnabledExtensionNames(extensions).setPNext(&messenger);
  }
  return {context, info};
} catch (const vk::IncompatibleDriverError&) {
  failUsage(driverFailure("no Vulkan driver", complaints));
} catch (const vk::SystemError& error) {
  // The loader says "out of host memory" for a driver's file that is not JSON; what it complained of says which.
  if (!complaints.empty()) failUsage(driverFailure("no Vulkan instance", complaints));
  fail(fmt::format("no Vulkan instance: {}", error.what()));
}

int rank(vk::PhysicalDeviceType type) {
  switch (type) {
    case vk::PhysicalDeviceType::eDiscreteGpu:
      return 0;
    case vk::PhysicalDeviceType::eIntegratedGpu:
      return 1;
    case vk::PhysicalDeviceType::eVirtualGpu:
      return 2;
    default:
      return 3;
  }
}

Adapter describe(const vk::raii::PhysicalDevice& physical, vk::QueueFlags queueFlags) {
  Adapter adapter{physical, physical.getProperties(), {}, {}, {}, 0, 0, ""};
  if (adapter.properties.apiVersion < kApiVersion) {
    adapter.whyNot = fmt::format("it has Vulkan {}, 1.2 is needed", adapter.apiVersionText());
    return adapter;
  }
  adapter.driver = physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties>()
                       .get<vk::PhysicalDeviceDriverProperties>();
  const auto features = physical.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan12Features>();
  adapter.features = features.get<vk::PhysicalDeviceFeatures2>().features;
  adapter.features12 = features.get<vk::PhysicalDeviceVulkan12Features>();
  adapter.features12.pNext = nullptr;
  const auto families = physical.getQueueFamilyProperties();
  const auto family = std::find_if(families.begin(), families.end(), [&](const vk::QueueFamilyProperties& f) {
    return (f.queueFlags & queueFlags) == queueFlags && f.timestampValidBits > 0;
  });
  if (family == families.end()) {
    adapter.whyNot = fmt::format("it has no queue with {} and timestamps", vk::to_string(queueFlags));
    return adapter;
  }
  adapter.queueFamily = static_cast<std::uint32_t>(family - families.begin());
  adapter.timestampBits = family->timestampValidBits;
  return adapter;
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

}  // namespace

std::vector<std::string> withMissingFiles(std::vector<std::string> complaints) {
  for (std::string& missing : missingFiles()) complaints.push_back(std::move(missing));
  return complaints;
}

std::string Adapter::driverText() const {
  const std::string name = driver.driverName.data(), version = driver.driverInfo.data();
  return name + (version.empty() ? fmt::format(" {:#x}", properties.driverVersion) : " " + version);
}

std::string Adapter::apiVersionText() const {
  const std::uint32_t version = properties.apiVersion;
  return fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version),
                     VK_API_VERSION_PATCH(version));
}

bool Adapter::isSoftware() const {
  return driver.driverID == vk::DriverId::eMesaLlvmpipe || driver.driverID == vk::DriverId::eGoogleSwiftshader;
}

Instance::Instance(bool validation, std::function<void(const std::string&)> onMessage)
    : context_(makeContext()),
      onMessage_(std::make_unique<std::function<void(const std::string&)>>(
          onMessage ? std::move(onMessage)
                    : [](const std::string& message) { support::say(stderr, "{}\n", message); })),
      instance_(makeInstance(context_, validation, onMessage_.get(), complaints_)) {
  if (validation) messenger_ = {instance_, messengerInfo(onMessage_.get())};
}

std::vector<Adapter> Instance::adapters(vk::QueueFlags queueFlags) const try {
  std::vector<Adapter> found;
  for (const auto& physical : instance_.enumeratePhysicalDevices()) found.push_back(describe(physical, queueFlags));
  // The loader puts it first; no one who did not ask for it should get it.
  std::ranges::stable_partition(found,
                                [](const Adapter& a) { return a.driver.driverID != vk::DriverId::eGoogleSwiftshader; });
  return found;
} catch (const vk::SystemError&) {
  return {};  // what the loader says when no driver loads
}

Adapter selectAdapter(std::vector<Adapter> adapters, const std::string& select,
                      const std::vector<std::string>& complaints) {
  if (adapters.empty()) failUsage(driverFailure("no Vulkan device: no driver found one", complaints));
  std::string known;
  for (std::size_t i = 0; i < adapters.size(); ++i)
    known += fmt::format("{}{} {}", i ? ", " : "", i, adapters[i].name());

  auto chosen = adapters.end();
  if (select.empty()) {
    chosen = std::min_element(adapters.begin(), adapters.end(), [](const Adapter& a, const Adapter& b) {
      return std::pair(!a.whyNot.empty(), rank(a.properties.deviceType)) <
             std::pair(!b.whyNot.empty(), rank(b.properties.deviceType));
    });
  } else if (std::all_of(select.begin(), select.end(), [](unsigned char c) { return std::isdigit(c); })) {
    const unsigned long index = select.size() < 9 ? std::stoul(select) : adapters.size();
    if (index < adapters.size()) chosen = adapters.begin() + static_cast<std::ptrdiff_t>(index);
  } else {
    chosen = std::find_if(adapters.begin(), adapters.end(),
                          [&](const Adapter& a) { return lower(a.name()).find(lower(select)) != std::string::npos; });
  }
  if (chosen == adapters.end()) {
    const std::vector<std::string> notes = withMissingFiles(complaints);
    failUsage(fmt::format("vulkan:{}: no such device; there are: {}{}{}", select, known, notes.empty() ? "" : "; ",
                          fmt::join(notes, "; ")));
  }
  if (!chosen->whyNot.empty())
    failUnsupported(fmt::format("vulkan: {} cannot be used: {}", chosen->name(), chosen->whyNot));
  return std::move(*chosen);
}

}  // namespace tessera::devices::vulkan

namespace tessera {

VulkanAdapters listVulkanAdapters() try {
  VulkanAdapters found;
  const devices::vulkan::Instance instance(false, {});
  auto& list = found.adapters;
  for (const auto& adapter : instance.adapters())
    list.push_back({static_cast<unsigned>(list.size()), adapter.name(), adapter.driverText(), adapter.apiVersionText(),
                    adapter.whyNot});
  if (list.empty())
    found.notes = {devices::vulkan::driverFailure("no Vulkan device: no driver found one", instance.complaints())};
  else
    found.notes = devices::vulkan::withMissingFiles(instance.complaints());
  return found;
} catch (const Error& error) {
  return {{}, {error.what()}};
}

}  // namespace tessera
