#include "mirror-kind.h"

#include <fmt/format.h>
#include <tessera/cpu-device.h>

namespace tessera::test {
namespace {

class MirrorDevice final : public Device {
 public:
  MirrorDevice(std::unique_ptr<Device> inner, std::shared_ptr<MirrorLog> log, const std::string& kind)
      : inner_(std::move(inner)), log_(std::move(log)), info_(inner_->info()) {
    info_.api = kind;
    info_.name = "Mirror of " + info_.name;
  }

  const DeviceInfo& info() const override { return info_; }
  std::unique_ptr<Buffer> createBuffer(std::size_t bytes, std::string_view name) override {
    ++log_->buffers;
    return inner_->createBuffer(bytes, name);
  }
  std::unique_ptr<Kernel> createKernel(const CompiledKernel& kernel) override {
    log_->kernels.push_back(kernel.stage);
    return inner_->createKernel(kernel);
  }
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
    ++log_->dispatches[kernel.compiled().stage];
    inner_->dispatch(kernel, bindings, block, groups);
  }
  void finish() override { inner_->finish(); }
  std::vector<StageTime> takeTimes() override { return inner_->takeTimes(); }
  std::uint64_t peakBufferBytes() const override { return inner_->peakBufferBytes(); }

 private:
  std::unique_ptr<Device> inner_;
  std::shared_ptr<MirrorLog> log_;
  DeviceInfo info_;
};

}  // namespace

DeviceKind mirrorKind(std::shared_ptr<MirrorLog> log, const std::string& name) {
  return {.name = name,
          .title = "mirror",
          .meaning = "what the CPU does, written down",
          .nickname = "looking-glass",
          .routes = {"cpp"},
          .takesThreads = true,
          .find =
              [] {
                return FoundDevices{.devices = {{.select = "", .name = "Mirror", .driver = "", .whyNot = ""}},
                                    .notes = {"the mirror is clean"}};
              },
          .open =
              [log, name](const std::string& select, const DeviceOptions& options) {
                log->opened.push_back(fmt::format("{}, {} threads", select, options.threads));
                return std::make_unique<MirrorDevice>(makeCpuDevice({.threads = options.threads}), log, name);
              }};
}

}  // namespace tessera::test
