// A device that runs on another one and writes down what it was asked: the frame as another host would have to run it.
#pragma once

#include <tessera/device.h>

#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace tessera::cli {

class Recorder final : public Device {
 public:
  /// Runs on `runs`; plans are made for `as`.
  Recorder(Device& runs, DeviceInfo as) : runs_(runs), info_(std::move(as)) {}

  const DeviceInfo& info() const override { return info_; }
  std::unique_ptr<Buffer> createBuffer(std::size_t bytes, std::string_view name) override;
  std::unique_ptr<Kernel> createKernel(const CompiledKernel& kernel) override { return runs_.createKernel(kernel); }
  void write(Buffer& buffer, std::size_t offset, std::span<const std::byte> data) override;
  void read(const Buffer& buffer, std::size_t offset, std::span<std::byte> data) override;
  void fill(Buffer& buffer, std::size_t offset, std::size_t bytes, std::uint32_t value) override;
  void dispatch(const Kernel& kernel, std::span<const Binding> bindings, std::span<const std::byte> block,
                std::uint32_t groups) override;
  void finish() override { runs_.finish(); }
  std::vector<StageTime> takeTimes() override { return runs_.takeTimes(); }
  std::uint64_t peakBufferBytes() const override { return runs_.peakBufferBytes(); }

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
  Device& runs_;
  DeviceInfo info_;
  std::vector<nlohmann::ordered_json> commands_;
  std::vector<BufferEntry> buffers_;
  std::map<std::string, std::vector<std::byte>> files_;
};

}  // namespace tessera::cli
