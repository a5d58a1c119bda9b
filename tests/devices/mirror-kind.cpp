#include "mirror-kind.h"

#include <fmt/format.h>
#include <tessera/cpu-device.h>

#include "host/devices/forwarding-device.h"

namespace tessera::test {
namespace {

class MirrorDevice final : public devices::ForwardingDevice {
 public:
  MirrorDevice(std::unique_ptr<Device> inner, std::shared_ptr<MirrorLog> log, const std::string& kind)
      : devices::ForwardingDevice(std::move(inner)), log_(std::move(log)) {
    info_.api = kind;
    info_.name = "Mirror of " + info_.name;
  }

  std::unique_ptr<Buffer> createBuffer(std::size_t bytes, std::string_view name) override {
    ++log_->buffers;
    return devices::ForwardingDevice::createBuffer(bytes, name);
  }
  std::unique_ptr<Kernel> createKernel(const CompiledKernel& kernel) override {
    log_->kernels.push_back(kernel.stage);
    return devices::ForwardingDevice::createKernel(kernel);
  }
  void dispatch(const Kernel& kernel, std::span<const Binding> bindings, std::span<const std::byte> block,
                std::uint32_t groups) override {
    ++log_->dispatches[kernel.compiled().stage];
    devices::ForwardingDevice::dispatch(kernel, bindings, block, groups);
  }

 private:
  std::shared_ptr<MirrorLog> log_;
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
