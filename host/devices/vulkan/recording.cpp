#include "host/devices/vulkan/recording.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

namespace tessera::devices::vulkan {
namespace {

// What one submission holds at most; beyond it the recording runs by itself.
constexpr std::uint32_t kMostDispatches = 1024, kMostStorageDescriptors = 16 * kMostDispatches;
constexpr vk::DeviceSize kBlocksBytes = 1u << 20;

vk::raii::DescriptorPool makeSetPool(const vk::raii::Device& device) {
  const std::array sizes{vk::DescriptorPoolSize(vk::DescriptorType::eStorageBuffer, kMostStorageDescriptors),
                         vk::DescriptorPoolSize(vk::DescriptorType::eUniformBuffer, kMostDispatches)};
  return {device, vk::DescriptorPoolCreateInfo({}, kMostDispatches, sizes)};
}

vk::raii::CommandBuffer makeCommands(const vk::raii::Device& device, const vk::raii::CommandPool& pool) {
  return std::move(device.allocateCommandBuffers({*pool, vk::CommandBufferLevel::ePrimary, 1}).front());
}

}  // namespace

Recording::Recording(std::shared_ptr<Machine> machine)
    : machine_(std::move(machine)),
      queue_(machine_->device, machine_->adapter.queueFamily, 0),
      commandPool_(machine_->device,
                   {vk::CommandPoolCreateFlagBits::eResetCommandBuffer, machine_->adapter.queueFamily}),
      commands_(makeCommands(machine_->device, commandPool_)),
      fence_(machine_->device, vk::FenceCreateInfo()),
      sets_(makeSetPool(machine_->device)),
      timestamps_(machine_->device, {{}, vk::QueryType::eTimestamp, 2 * kMostDispatches}),
      blocks_(machine_, kBlocksBytes, vk::BufferUsageFlagBits::eUniformBuffer, Residence::kHost, "uniform blocks"),
      blockAlignment_(
          std::max<vk::DeviceSize>(machine_->adapter.properties.limits.minUniformBufferOffsetAlignment, 16)) {}

void Recording::begin() {
  if (!open_) {
    commands_.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    commands_.resetQueryPool(*timestamps_, 0, 2 * kMostDispatches);
    open_ = true;
  }
  using Stage = vk::PipelineStageFlagBits;
  using Access = vk::AccessFlagBits;
  const vk::MemoryBarrier all(
      Access::eShaderWrite | Access::eTransferWrite,
      Access::eShaderRead | Access::eShaderWrite | Access::eTransferRead | Access::eTransferWrite);
  commands_.pipelineBarrier(Stage::eComputeShader | Stage::eTransfer, Stage::eComputeShader | Stage::eTransfer, {}, all,
                            {}, {});
}

void Recording::fill(std::shared_ptr<Block> to, vk::DeviceSize offset, vk::DeviceSize bytes, std::uint32_t value) {
  translated("vulkan: fill", [&] {
    begin();
    commands_.fillBuffer(to->handle(), offset, bytes, value);
  });
  inUse_.push_back(std::move(to));
}

void Recording::copy(std::shared_ptr<Block> from, vk::DeviceSize fromOffset, std::shared_ptr<Block> to,
                     vk::DeviceSize toOffset, vk::DeviceSize bytes) {
  translated("vulkan: copy", [&] {
    begin();
    commands_.copyBuffer(from->handle(), to->handle(), vk::BufferCopy(fromOffset, toOffset, bytes));
  });
  inUse_.push_back(std::move(from));
  inUse_.push_back(std::move(to));
}

vk::DescriptorSet Recording::makeSet(const VulkanKernel& kernel, std::span<const BoundBuffer> buffers,
                                     std::span<const std::byte> block) {
  // The plain handle, not the RAII one: the whole pool is reset after each run.
  const vk::DescriptorSetAllocateInfo info(*sets_, *kernel.pipeline()->setLayout);
  const vk::DescriptorSet set =
      (*machine_->device).allocateDescriptorSets(info, *machine_->device.getDispatcher()).front();

  std::vector<vk::DescriptorBufferInfo> infos;
  infos.reserve(buffers.size() + 1);  // the writes point into it
  std::vector<vk::WriteDescriptorSet> writes;
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    const vk::DeviceSize words =
        std::max<vk::DeviceSize>((buffers[i].bytes + 3) / 4, 1);  // Vulkan binds no empty range
    infos.emplace_back(buffers[i].block->handle(), 0, 4 * words);
    writes.emplace_back(set, kernel.storage()[i].binding, 0, 1, vk::DescriptorType::eStorageBuffer, nullptr,
                        &infos.back());
  }
  if (kernel.hasBlock()) {
    std::memcpy(blocks_.mapped() + blockBytes_, block.data(), block.size());
    infos.emplace_back(blocks_.handle(), blockBytes_, block.size());
    writes.emplace_back(set, kernel.blockBinding(), 0, 1, vk::DescriptorType::eUniformBuffer, nullptr, &infos.back());
    blockBytes_ += (block.size() + blockAlignment_ - 1) / blockAlignment_ * blockAlignment_;
  }
  machine_->device.updateDescriptorSets(writes, {});
  return set;
}

void Recording::dispatch(const VulkanKernel& kernel, std::span<const BoundBuffer> buffers,
                         std::span<const std::byte> block, std::uint32_t groupsX, std::uint32_t groupsY) {
  const auto storage = static_cast<std::uint32_t>(buffers.size());
  if (stages_.size() == kMostDispatches || storageDescriptors_ + storage > kMostStorageDescriptors ||
      blockBytes_ + block.size() > kBlocksBytes)
    run();
  const std::string& stage = kernel.compiled().stage;
  translated("vulkan: kernel " + stage, [&] {
    begin();
    const vk::DescriptorSet set = makeSet(kernel, buffers, block);
    const auto& pipeline = *kernel.pipeline();
    const auto query = static_cast<std::uint32_t>(2 * stages_.size());
    commands_.bindPipeline(vk::PipelineBindPoint::eCompute, *pipeline.pipeline);
    commands_.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *pipeline.layout, 0, set, {});
    // At the bottom of the pipe: once all before it has finished, which the barrier makes the start of this dispatch.
    commands_.writeTimestamp(vk::PipelineStageFlagBits::eBottomOfPipe, *timestamps_, query);
    commands_.dispatch(groupsX, groupsY, 1);
    commands_.writeTimestamp(vk::PipelineStageFlagBits::eBottomOfPipe, *timestamps_, query + 1);
  });
  storageDescriptors_ += storage;
  stages_.push_back(stage);
  inUse_.push_back(kernel.pipeline());
  for (const BoundBuffer& buffer : buffers) inUse_.push_back(buffer.block);
}

void Recording::run() {
  if (!open_) return;
  translated("vulkan: " + machine_->adapter.name(), [&] {
    const vk::MemoryBarrier toHost(vk::AccessFlagBits::eShaderWrite | vk::AccessFlagBits::eTransferWrite,
                                   vk::AccessFlagBits::eHostRead);
    commands_.pipelineBarrier(vk::PipelineStageFlagBits::eComputeShader | vk::PipelineStageFlagBits::eTransfer,
                              vk::PipelineStageFlagBits::eHost, {}, toHost, {}, {});
    commands_.end();
    queue_.submit(vk::SubmitInfo({}, {}, *commands_), *fence_);
    const auto waited = machine_->device.waitForFences(*fence_, VK_TRUE, ~0ull);
    if (waited != vk::Result::eSuccess) fail("vulkan: waiting for the device: " + vk::to_string(waited));
    machine_->device.resetFences(*fence_);
    readTimestamps();
    commands_.reset();
    sets_.reset();
  });
  open_ = false;
  blockBytes_ = 0;
  storageDescriptors_ = 0;
  stages_.clear();
  inUse_.clear();
}

void Recording::readTimestamps() {
  if (stages_.empty()) return;
  const auto count = static_cast<std::uint32_t>(2 * stages_.size());
  const auto [result, ticks] =
      timestamps_.getResults<std::uint64_t>(0, count, count * sizeof(std::uint64_t), sizeof(std::uint64_t),
                                            vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait);
  if (result != vk::Result::eSuccess) fail("vulkan: reading timestamps: " + vk::to_string(result));
  if (!hasFirstTick_) firstTick_ = ticks.front();
  hasFirstTick_ = true;
  // From the first tick on: the counter has `timestampBits` bits and may wrap, and a double holds small numbers
  // exactly.
  const std::uint32_t bits = machine_->adapter.timestampBits;
  const std::uint64_t mask = bits == 64 ? ~0ull : (1ull << bits) - 1;
  const double period = machine_->adapter.properties.limits.timestampPeriod;  // ns a tick
  const auto nanoseconds = [&](std::uint64_t tick) {
    return static_cast<std::uint64_t>(static_cast<double>((tick - firstTick_) & mask) * period);
  };
  for (std::size_t i = 0; i < stages_.size(); ++i)
    times_.push_back({std::move(stages_[i]), nanoseconds(ticks[2 * i]), nanoseconds(ticks[2 * i + 1])});
}

std::vector<StageTime> Recording::takeTimes() { return std::exchange(times_, {}); }

}  // namespace tessera::devices::vulkan
