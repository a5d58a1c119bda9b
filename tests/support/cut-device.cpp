#include "cut-device.h"

#include <fmt/format.h>
#include <tessera/error.h>

#include "host/devices/forwarding-device.h"

namespace tessera::test {
namespace {

class CutDevice final : public devices::ForwardingDevice {
 public:
  CutDevice(std::unique_ptr<Device> inner, std::uint64_t bytes, std::uint32_t iterations)
      : devices::ForwardingDevice(std::move(inner)) {
    if (bytes != 0) info_.maxBufferBytes = bytes;
    if (iterations != 0) info_.maxLoopIterations = iterations;
  }

  std::unique_ptr<Buffer> createBuffer(std::size_t bytes, std::string_view name) override {
    if (bytes > info_.maxBufferBytes)
      failUnsupported(fmt::format("buffer {}: {} bytes, the largest has {}", name, bytes, info_.maxBufferBytes));
    return devices::ForwardingDevice::createBuffer(bytes, name);
  }
};

}  // namespace

std::unique_ptr<Device> makeCutDevice(std::unique_ptr<Device> inner, std::uint64_t maxBufferBytes,
                                      std::uint32_t maxLoopIterations) {
  return std::make_unique<CutDevice>(std::move(inner), maxBufferBytes, maxLoopIterations);
}

}  // namespace tessera::test
