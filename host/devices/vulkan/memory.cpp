#include "host/devices/vulkan/memory.h"

#include <fmt/format.h>

#include <algorithm>

namespace tessera::devices::vulkan {
namespace {

vk::raii::Device makeDevice(const Adapter& adapter) {
  // Enabled where there: what Slang's modules may ask for. A kernel that needs what is not there is refused by name.
  vk::PhysicalDeviceVulkan12Features features12;
  features12.shaderBufferInt64Atomics = adapter.features12.shaderBufferInt64Atomics;
  features12.shaderSharedInt64Atomics = adapter.features12.shaderSharedInt64Atomics;
  features12.scalarBlockLayout = adapter.features12.scalarBlockLayout;
  features12.uniformBufferStandardLayout = adapter.features12.uniformBufferStandardLayout;
  features12.vulkanMemoryModel = adapter.features12.vulkanMemoryModel;
  features12.vulkanMemoryModelDeviceScope = adapter.features12.vulkanMemoryModelDeviceScope;
  vk::PhysicalDeviceFeatures features;
  features.shaderInt64 = adapter.features.shaderInt64;
  features.shaderFloat64 = adapter.features.shaderFloat64;
  // For the draw baseline: gl_PrimitiveID in fragment shaders, and large meshes.
  features.geometryShader = adapter.features.geometryShader;
  features.fullDrawIndexUint32 = adapter.features.fullDrawIndexUint32;
  const float priority = 1.0f;
  const vk::DeviceQueueCreateInfo queue({}, adapter.queueFamily, 1, &priority);
  const vk::DeviceCreateInfo info({}, queue, {}, {}, &features, &features12);
  return translated("vulkan: " + adapter.name(), [&] { return vk::raii::Device(adapter.physical, info); });
}

}  // namespace

Machine::Machine(const VulkanOptions& options, vk::QueueFlags queueFlags)
    : instance(options.validation, options.onMessage),
      adapter(selectAdapter(instance.adapters(queueFlags), options.select, instance.complaints())),
      device(makeDevice(adapter)),
      memory(adapter.physical.getMemoryProperties()),
      staged(options.staged),
      boundsChecks(options.boundsChecks) {}

int Machine::memoryType(std::uint32_t typeBits, vk::MemoryPropertyFlags flags) const {
  for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i)
    if ((typeBits >> i & 1) != 0 && (memory.memoryTypes[i].propertyFlags & flags) == flags) return static_cast<int>(i);
  return -1;
}

Block::Block(std::shared_ptr<Machine> machine, std::uint64_t bytes, vk::BufferUsageFlags usage, Residence residence,
             const std::string& name)
    : machine_(std::move(machine)), bytes_(bytes) {
  using Flag = vk::MemoryPropertyFlagBits;
  constexpr auto kHostFast = Flag::eHostVisible | Flag::eHostCoherent | Flag::eHostCached;
  // The better type first, then the one that every driver has. Device memory that the host sees uncached, across a bus,
  // is left unmapped: reading it is slow.
  const vk::MemoryPropertyFlags must =
      residence == Residence::kDevice ? Flag::eDeviceLocal : Flag::eHostVisible | Flag::eHostCoherent;
  translated(fmt::format("vulkan: buffer '{}' of {} bytes", name, bytes), [&] {
    buffer_ = {machine_->device, vk::BufferCreateInfo({}, bytes, usage)};
    const vk::MemoryRequirements needs = buffer_.getMemoryRequirements();
    int type = machine_->memoryType(needs.memoryTypeBits, must | kHostFast);
    if (type < 0) type = machine_->memoryType(needs.memoryTypeBits, must);
    memory_ = {machine_->device, vk::MemoryAllocateInfo(needs.size, static_cast<std::uint32_t>(type))};
    buffer_.bindMemory(*memory_, 0);
    const auto flags = machine_->memory.memoryTypes[static_cast<std::size_t>(type)].propertyFlags;
    if (residence == Residence::kHost || (!machine_->staged && (flags & kHostFast) == kHostFast))
      mapped_ = static_cast<std::byte*>(memory_.mapMemory(0, VK_WHOLE_SIZE));
  });
  machine_->heldBytes += bytes_;
  machine_->peakBytes = std::max(machine_->peakBytes, machine_->heldBytes);
}

Block::~Block() { machine_->heldBytes -= bytes_; }

}  // namespace tessera::devices::vulkan
