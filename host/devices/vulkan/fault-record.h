// The buffer in which a checked kernel finds how long its buffers are and leaves its first index out of range.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "host/devices/vulkan/recording.h"

namespace tessera::devices::vulkan {

class FaultRecord {
 public:
  explicit FaultRecord(std::shared_ptr<Machine> machine);

  const std::shared_ptr<Block>& block() const { return block_; }
  /// For one dispatch. `buffers` in the order of the kernel's storage().
  void prepare(const VulkanKernel& kernel, std::span<const BoundBuffer> buffers);
  /// Throws what failOutOfBounds() does where that dispatch, which has run, left a fault.
  void judge(const VulkanKernel& kernel) const;

 private:
  std::uint32_t* words() const { return reinterpret_cast<std::uint32_t*>(block_->mapped()); }
  std::shared_ptr<Block> block_;
};

}  // namespace tessera::devices::vulkan
