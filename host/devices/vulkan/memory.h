// Device buffers, each an allocation of its own (a frame needs a few dozen), and the machine they live on.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "host/devices/vulkan/instance.h"

namespace tessera::devices::vulkan {

/// What buffers, kernels and the device share; whichever goes last takes it down.
struct Machine {
  Instance instance;
  Adapter adapter;
  vk::raii::Device device;
  vk::PhysicalDeviceMemoryProperties memory;
  bool staged, boundsChecks;  ///< as in VulkanOptions
  std::uint64_t heldBytes = 0, peakBytes = 0;

  explicit Machine(const VulkanOptions& options, vk::QueueFlags queueFlags = vk::QueueFlagBits::eCompute);
  /// The first memory type allowed by `typeBits` that has `flags`, or -1.
  int memoryType(std::uint32_t typeBits, vk::MemoryPropertyFlags flags) const;
};

enum class Residence {
  kDevice,  ///< device-local; mapped where the host reads that memory at full speed (lavapipe, integrated GPUs)
  kHost,    ///< host-visible, coherent, cached where there is such a type; always mapped
};

/// A Vulkan buffer with its memory. Counted into the machine's held and peak bytes.
class Block {
 public:
  Block(std::shared_ptr<Machine> machine, std::uint64_t bytes, vk::BufferUsageFlags usage, Residence residence,
        const std::string& name);
  ~Block();
  Block(const Block&) = delete;

  vk::Buffer handle() const { return *buffer_; }
  std::uint64_t bytes() const { return bytes_; }
  std::byte* mapped() const { return mapped_; }  ///< nullptr where the host does not see it

 private:
  std::shared_ptr<Machine> machine_;
  std::uint64_t bytes_;
  vk::raii::Buffer buffer_ = nullptr;
  vk::raii::DeviceMemory memory_ = nullptr;
  std::byte* mapped_ = nullptr;
};

}  // namespace tessera::devices::vulkan
