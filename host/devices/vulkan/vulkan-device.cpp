#include <fmt/format.h>
#include <tessera/vulkan-device.h>

#include <algorithm>
#include <cstring>
#include <optional>

#include "host/devices/kernel-fault.h"
#include "host/devices/kinds.h"
#include "host/devices/vulkan/fault-record.h"
#include "host/devices/vulkan/recording.h"

namespace tessera::devices::vulkan {
namespace {

constexpr vk::DeviceSize kStagingBytes = 16u << 20;

class VulkanBuffer : public Buffer {
 public:
  VulkanBuffer(std::shared_ptr<Block> block, std::size_t bytes, std::string name)
      : block_(std::move(block)), bytes_(bytes), name_(std::move(name)) {}
  std::size_t bytes() const override { return bytes_; }
  const std::shared_ptr<Block>& block() const { return block_; }
  void checkRange(const char* what, std::size_t offset, std::size_t size) const {
    if (offset > bytes_ || size > bytes_ - offset)
      fail(fmt::format("{} of {} bytes at {} of buffer '{}', which has {}", what, size, offset, name_, bytes_));
  }

 private:
  std::shared_ptr<Block> block_;
  std::size_t bytes_;
  std::string name_;
};

const VulkanBuffer& ours(const Buffer& buffer) {
  const auto* mine = dynamic_cast<const VulkanBuffer*>(&buffer);
  if (mine == nullptr) fail("a buffer of another device was given to a Vulkan device");
  return *mine;
}

DeviceInfo describe(const Adapter& adapter) {
  const auto& limits = adapter.properties.limits;
  const auto maintenance3 =
      adapter.physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceMaintenance3Properties>()
          .get<vk::PhysicalDeviceMaintenance3Properties>();
  DeviceInfo info;
  const DeviceKind kind = vulkanKind();
  info.api = kind.name;
  info.routes = kind.routes;
  info.name = adapter.name();
  info.driver = fmt::format("{}, Vulkan {}", adapter.driverText(), adapter.apiVersionText());
  info.correctnessOnly = adapter.isSoftware();
  info.int64 = adapter.features.shaderInt64;
  info.float64 = adapter.features.shaderFloat64;
  info.atomicMin64 = info.int64 && adapter.features12.shaderBufferInt64Atomics;
  info.groupAtomicMin64 = info.int64 && adapter.features12.shaderSharedInt64Atomics;
  info.maxBufferBytes = std::min<std::uint64_t>(limits.maxStorageBufferRange, maintenance3.maxMemoryAllocationSize);
  // lavapipe 22.3 stops an invocation after 65,535 iterations of its loops together, without an error. Elsewhere the
  // bound keeps one dispatch well below the seconds after which a desktop's watchdog resets the GPU.
  info.maxLoopIterations = adapter.driver.driverID == vk::DriverId::eMesaLlvmpipe ? 65535 : 1u << 20;
  info.maxGroupsPerDimension = std::min(limits.maxComputeWorkGroupCount[0], limits.maxComputeWorkGroupCount[1]);
  info.maxGroupBytes = limits.maxComputeSharedMemorySize;
  info.timeClock = "timestamp";
  return info;
}

class VulkanDevice : public Device {
 public:
  explicit VulkanDevice(const VulkanOptions& options)
      : machine_(std::make_shared<Machine>(options)), info_(describe(machine_->adapter)), recording_(machine_) {
    if (options.boundsChecks) faults_.emplace(machine_);
  }

  const DeviceInfo& info() const override { return info_; }

  std::unique_ptr<Buffer> createBuffer(std::size_t bytes, std::string_view name) override {
    if (bytes > info_.maxBufferBytes)
      failUnsupported(
          fmt::format("buffer '{}' of {} bytes: {} binds at most {}", name, bytes, info_.name, info_.maxBufferBytes));
    using Usage = vk::BufferUsageFlagBits;
    constexpr std::size_t kSmallest = 256;  // no element is larger
    auto block = std::make_shared<Block>(machine_, std::max((bytes + 3) / 4 * 4, kSmallest),
                                         Usage::eStorageBuffer | Usage::eTransferSrc | Usage::eTransferDst,
                                         Residence::kDevice, std::string(name));
    return std::make_unique<VulkanBuffer>(std::move(block), bytes, std::string(name));
  }

  std::unique_ptr<Kernel> createKernel(const CompiledKernel& kernel) override {
    return std::make_unique<VulkanKernel>(machine_, kernel);
  }

  void write(Buffer& buffer, std::size_t offset, std::span<const std::byte> data) override {
    const VulkanBuffer& to = ours(buffer);
    to.checkRange("write", offset, data.size());
    if (data.empty()) return;
    if (to.block()->mapped() != nullptr) {
      finish();
      std::memcpy(to.block()->mapped() + offset, data.data(), data.size());
      return;
    }
    while (!data.empty()) {
      if (stagedBytes_ == kStagingBytes) finish();
      const std::size_t size = std::min<std::size_t>(data.size(), kStagingBytes - stagedBytes_);
      std::memcpy(staging().mapped() + stagedBytes_, data.data(), size);
      recording_.copy(staging_, stagedBytes_, to.block(), offset, size);
      stagedBytes_ += size;
      offset += size;
      data = data.subspan(size);
    }
  }

  void read(const Buffer& buffer, std::size_t offset, std::span<std::byte> data) override {
    const VulkanBuffer& from = ours(buffer);
    from.checkRange("read", offset, data.size());
    finish();
    if (data.empty()) return;
    if (from.block()->mapped() != nullptr) {
      std::memcpy(data.data(), from.block()->mapped() + offset, data.size());
      return;
    }
    while (!data.empty()) {
      const std::size_t size = std::min<std::size_t>(data.size(), kStagingBytes);
      staging();
      recording_.copy(from.block(), offset, staging_, 0, size);
      finish();
      std::memcpy(data.data(), staging_->mapped(), size);
      offset += size;
      data = data.subspan(size);
    }
  }

  void fill(Buffer& buffer, std::size_t offset, std::size_t bytes, std::uint32_t value) override {
    const VulkanBuffer& to = ours(buffer);
    to.checkRange("fill", offset, bytes);
    if (offset % 4 != 0 || bytes % 4 != 0)
      fail(fmt::format("fill of {} bytes at {}: both must be multiples of 4", bytes, offset));
    if (bytes > 0) recording_.fill(to.block(), offset, bytes, value);
  }

  void dispatch(const Kernel& kernel, std::span<const Binding> bindings, std::span<const std::byte> block,
                std::uint32_t groups) override {
    const auto* ourKernel = dynamic_cast<const VulkanKernel*>(&kernel);
    if (ourKernel == nullptr) fail("a kernel of another device was given to a Vulkan device");
    const std::string& stage = kernel.compiled().stage;
    std::vector<BoundBuffer> buffers;
    for (const auto& resource : ourKernel->storage()) {
      if (resource.name == kFaultsName) {
        buffers.push_back({faults_->block(), faults_->block()->bytes()});
        continue;
      }
      const auto bound =
          std::find_if(bindings.begin(), bindings.end(), [&](const Binding& b) { return b.name == resource.name; });
      if (bound == bindings.end() || bound->buffer == nullptr)
        fail(fmt::format("kernel {}: nothing is bound to '{}'", stage, resource.name));
      buffers.push_back({ours(*bound->buffer).block(), bound->buffer->bytes()});
    }
    const std::uint32_t expected = kernel.compiled().interface.blockSize;
    if (ourKernel->hasBlock() && block.size() != expected)
      fail(fmt::format("kernel {}: a uniform block of {} bytes was given, it has {}", stage, block.size(), expected));
    if (groups == 0) return;

    const std::uint32_t most = std::min(info_.maxGroupsPerDimension, 65535u);
    const bool oneRow = groups <= most;
    const std::uint32_t rows = oneRow ? 1 : (groups - 1) / kGroupRow + 1;
    if (rows > most)
      failUnsupported(fmt::format("kernel {}: {} groups, {} runs at most {}", stage, groups, info_.name,
                                  std::uint64_t{most} * kGroupRow));
    if (!ourKernel->checks()) {
      recording_.dispatch(*ourKernel, buffers, block, oneRow ? groups : kGroupRow, rows);
      return;
    }
    finish();  // what ran before is not this kernel's
    faults_->prepare(*ourKernel, buffers);
    const RunningKernel running(ourKernel->description());
    recording_.dispatch(*ourKernel, buffers, block, oneRow ? groups : kGroupRow, rows);
    finish();
    faults_->judge(*ourKernel);
  }

  void finish() override {
    recording_.run();
    stagedBytes_ = 0;
  }

  std::vector<StageTime> takeTimes() override {
    finish();
    return recording_.takeTimes();
  }

  std::uint64_t peakBufferBytes() const override { return machine_->peakBytes; }

 private:
  Block& staging() {
    if (!staging_)
      staging_ = std::make_shared<Block>(machine_, kStagingBytes,
                                         vk::BufferUsageFlagBits::eTransferSrc | vk::BufferUsageFlagBits::eTransferDst,
                                         Residence::kHost, "staging");
    return *staging_;
  }

  std::shared_ptr<Machine> machine_;
  DeviceInfo info_;
  Recording recording_;
  std::shared_ptr<Block> staging_;     // made when a buffer is not mapped
  vk::DeviceSize stagedBytes_ = 0;     // of it, since the last finish
  std::optional<FaultRecord> faults_;  // where kernels are checked
};

}  // namespace
}  // namespace tessera::devices::vulkan

std::unique_ptr<tessera::Device> tessera::makeVulkanDevice(const VulkanOptions& options) {
  return std::make_unique<devices::vulkan::VulkanDevice>(options);
}
