// A device that hands each call to another device: the base of devices that watch the calls or promise less.
#pragma once

#include <tessera/device.h>

#include <memory>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace tessera::devices {

/// Forwards every call but borrow(): the caller copies its memory, so that a derived class sees each byte in write().
/// What info() says is the derived class' own.
class ForwardingDevice : public Device {
 public:
  const DeviceInfo& info() const override { return info_; }
  std::unique_ptr<Buffer> createBuffer(std::size_t bytes, std::string_view name) override {
    return inner_.createBuffer(bytes, name);
  }
  std::unique_ptr<Kernel> createKernel(const CompiledKernel& kernel) override { return inner_.createKernel(kernel); }
  void write(Buffer& buffer, std::size_t offset, std::span<const std::byte> data) override {
    inner_.write(buffer, offset, data);
  }
  void read(const Buffer& buffer, std::size_t offset, std::span<std::byte> data) override {
    inner_.read(buffer, offset, data);
  }
  void fill(Buffer& buffer, std::size_t offset, std::size_t bytes, std::uint32_t value) override {
    inner_.fill(buffer, offset, bytes, value);
  }
  void dispatch(const Kernel& kernel, std::span<const Binding> bindings, std::span<const std::byte> block,
                std::uint32_t groups) override {
    inner_.dispatch(kernel, bindings, block, groups);
  }
  void finish() override { inner_.finish(); }
  std::vector<StageTime> takeTimes() override { return inner_.takeTimes(); }
  std::uint64_t peakBufferBytes() const override { return inner_.peakBufferBytes(); }

 protected:
  /// `inner` outlives this device.
  ForwardingDevice(Device& inner, DeviceInfo info) : inner_(inner), info_(std::move(info)) {}
  /// Begins with the info of `inner`.
  explicit ForwardingDevice(std::unique_ptr<Device> inner)
      : owned_(std::move(inner)), inner_(*owned_), info_(inner_.info()) {}

 private:
  std::unique_ptr<Device> owned_;  // null where the device is another's

 protected:
  Device& inner_;
  DeviceInfo info_;
};

}  // namespace tessera::devices
