#include "cut-device.h"

#include <fmt/format.h>
#include <tessera/error.h>

namespace tessera {
namespace {

class CutDevice final : public Device {
 public:
  CutDevice(std::unique_ptr<Device> inner, std::uint64_t bytes, std::uint32_t iterations)
      : inner_(std::move(inner)), info_(inner_->info()) {
    if (bytes != 0) info_.maxBufferBytes = bytes;
    if (iterations != 0) info_.maxLoopIterations = iterations;
  }

  const DeviceInfo& info() const override { return info_; }
  std::unique_ptr<Buffer> createBuffer(std::size_t bytes, std::string_view name) override {
    if (bytes > info_.maxBufferBytes)
      failUnsupported(fmt::format("buffer {}: {} bytes, the largest has {}", name, bytes, info_.maxBufferBytes));
    return inner_->createBuffer(bytes, name);
  }
  std::unique_ptr<Kernel> createKernel(const CompiledKernel& kernel) override { return inner_->createKernel(kernel); }
  void write(Buffer& buffer, std::size_t offset, std::span<const std::byte> data) override {
    inner_->write(buffer, offset, data);
  }
  void read(const Buffer& buffer, std::size_t offset, std::span<std::byte> data) override {
    inner_->read(buffer, offset, data);
  }
  void fill(Buffer& buffer, std::size_t offset, std::size_t bytes, std::uint32_t value) override {
    inner_->fill(buffer, offset, bytes, value);
  }
  void dispatch(const Kernel& kernel, std::span<const Binding> bindings, std::span<const std::byte> block,
                std::uint32_t groups) override {
    inner_->dispatch(kernel, bindings, block, groups);
  }
  void finish() override { inner_->finish(); }
  std::vector<StageTime> takeTimes() override { return inner_->takeTimes(); }
  std::uint64_t peakBufferBytes() const override { return inner_->peakBufferBytes(); }

 private:
  std::unique_ptr<Device> inner_;
  DeviceInfo info_;
};

}  // namespace

std::unique_ptr<Device> makeCutDevice(std::unique_ptr<Device> inner, std::uint64_t maxBufferBytes,
                                      std::uint32_t maxLoopIterations) {
  return std::make_unique<CutDevice>(std::move(inner), maxBufferBytes, maxLoopIterations);
}

}  // namespace tessera
