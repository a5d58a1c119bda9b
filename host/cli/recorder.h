// A device that runs on another one and writes down what it was asked: the frame as another host would have to run it.
#pragma once

#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "host/devices/forwarding-device.h"

namespace tessera::cli {

class Recorder final : public devices::ForwardingDevice {
 public:
  /// Runs on `runs`; plans are made for `as`.
  Recorder(Device& runs, DeviceInfo as) : devices::ForwardingDevice(runs, std::move(as)) {}

  std::unique_ptr<Buffer> createBuffer(std::size_t bytes, std::string_view name) override;
  void write(Buffer& buffer, std::size_t offset, std::span<const std::byte> data) override;
  void read(const Buffer& buffer, std::size_t offset, std::span<std::byte> data) override;
  void fill(Buffer& buffer, std::size_t offset, std::size_t bytes, std::uint32_t value) override;
  void dispatch(const Kernel& kernel, std::span<const Binding> bindings, std::span<const std::byte> block,
                std::uint32_t groups) override;

  /// In the order in which they were asked for: {"do": "write" | "fill" | "dispatch" | "read", ...}.
  const std::vector<nlohmann::ordered_json>& commands() const { return commands_; }
  struct BufferEntry {
    std::string name;      ///< of its own; "NAME 2" where a larger one took the place of NAME
    std::string pipeline;  ///< what the pipeline calls it
    std::size_t bytes;
  };
  const std::vector<BufferEntry>& buffers() const { return buffers_; }
  /// What "write" commands name.
  const std::map<std::string, std::vector<std::byte>>& files() const { return files_; }

 private:
  std::vector<nlohmann::ordered_json> commands_;
  std::vector<BufferEntry> buffers_;
  std::map<std::string, std::vector<std::byte>> files_;
};

}  // namespace tessera::cli
