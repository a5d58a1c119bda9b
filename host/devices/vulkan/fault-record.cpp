#include "host/devices/vulkan/fault-record.h"

#include <algorithm>
#include <limits>

#include "host/devices/kernel-fault.h"

namespace tessera::devices::vulkan {
namespace {

constexpr std::uint64_t kMostBuffers = 1024;  // a device binds some tens

}  // namespace

FaultRecord::FaultRecord(std::shared_ptr<Machine> machine)
    : block_(std::make_shared<Block>(std::move(machine), (kernels::kFaultWords + kMostBuffers) * sizeof(std::uint32_t),
                                     vk::BufferUsageFlagBits::eStorageBuffer, Residence::kHost, "faults")) {}

void FaultRecord::prepare(const VulkanKernel& kernel, std::span<const BoundBuffer> buffers) {
  const auto& counted = kernel.checks()->counted;
  if (counted.size() > kMostBuffers) fail("more buffers than bounds checks count");
  words()[kernels::kFaultAccess] = 0;
  for (std::size_t i = 0; i < counted.size(); ++i) {
    const auto& storage = kernel.storage();
    const auto at = std::ranges::find(storage, counted[i], &VulkanKernel::Resource::name) - storage.begin();
    const std::uint64_t count =
        buffers[static_cast<std::size_t>(at)].bytes / kernel.compiled().interface.elementSizes.at(counted[i]);
    words()[kernels::kFaultWords + i] =
        static_cast<std::uint32_t>(std::min<std::uint64_t>(count, std::numeric_limits<std::uint32_t>::max()));
  }
}

void FaultRecord::judge(const VulkanKernel& kernel) const {
  if (words()[kernels::kFaultAccess] == 0) return;
  const kernels::CheckedSpirv::Access& access = kernel.checks()->accesses.at(words()[kernels::kFaultAccess] - 1);
  std::int64_t index = words()[kernels::kFaultIndex];
  if (access.isWide)
    index |= static_cast<std::int64_t>(std::uint64_t{words()[kernels::kFaultHigh]} << 32);
  else if (access.isSigned)
    index = static_cast<std::int32_t>(words()[kernels::kFaultIndex]);
  failOutOfBounds(kernel.compiled(), "vulkan", index, words()[kernels::kFaultCount], access.what);
}

}  // namespace tessera::devices::vulkan
