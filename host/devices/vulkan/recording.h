// Commands recorded one after another into one command buffer, run when asked for or when a pool is full.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "host/devices/vulkan/vulkan-kernel.h"

namespace tessera::devices::vulkan {

/// A buffer as a kernel sees it: no larger than it was asked for, whatever its block holds.
struct BoundBuffer {
  std::shared_ptr<Block> block;
  std::uint64_t bytes;
};

class Recording {
 public:
  explicit Recording(std::shared_ptr<Machine> machine);

  void fill(std::shared_ptr<Block> to, vk::DeviceSize offset, vk::DeviceSize bytes, std::uint32_t value);
  void copy(std::shared_ptr<Block> from, vk::DeviceSize fromOffset, std::shared_ptr<Block> to, vk::DeviceSize toOffset,
            vk::DeviceSize bytes);
  /// `buffers` in the order of the kernel's storage().
  void dispatch(const VulkanKernel& kernel, std::span<const BoundBuffer> buffers, std::span<const std::byte> block,
                std::uint32_t groupsX, std::uint32_t groupsY);
  /// Submits what was recorded and waits for it.
  void run();
  /// Times of the dispatches that have run since the last call.
  std::vector<StageTime> takeTimes();

 private:
  void begin();  // opens the command buffer if it is not open; then a barrier, so that all before is seen
  void readTimestamps();
  vk::DescriptorSet makeSet(const VulkanKernel& kernel, std::span<const BoundBuffer> buffers,
                            std::span<const std::byte> block);

  std::shared_ptr<Machine> machine_;
  vk::raii::Queue queue_;
  vk::raii::CommandPool commandPool_;
  vk::raii::CommandBuffer commands_;
  vk::raii::Fence fence_;
  vk::raii::DescriptorPool sets_;
  vk::raii::QueryPool timestamps_;  // two a dispatch
  Block blocks_;                    // uniform blocks of the recorded dispatches, one after another
  vk::DeviceSize blockAlignment_;
  vk::DeviceSize blockBytes_ = 0;  // of it in use

  bool open_ = false;
  std::uint32_t storageDescriptors_ = 0;            // taken from the pool since the last run
  std::vector<std::string> stages_;                 // of the recorded dispatches
  std::vector<std::shared_ptr<const void>> inUse_;  // what the recorded commands refer to
  std::vector<StageTime> times_;
  bool hasFirstTick_ = false;
  std::uint64_t firstTick_ = 0;
};

}  // namespace tessera::devices::vulkan
