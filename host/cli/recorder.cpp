#include "host/cli/recorder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace tessera::cli {
namespace {

using Json = nlohmann::ordered_json;

struct RecordedBuffer final : Buffer {
  RecordedBuffer(std::unique_ptr<Buffer> runs, std::string name) : runs(std::move(runs)), name(std::move(name)) {}
  std::size_t bytes() const override { return runs->bytes(); }
  std::unique_ptr<Buffer> runs;
  std::string name;
};

const RecordedBuffer& recorded(const Buffer& buffer) { return dynamic_cast<const RecordedBuffer&>(buffer); }

Json fieldValue(std::span<const std::byte> block, const KernelInterface::Field& field) {
  if (field.floating) {
    float value;
    std::memcpy(&value, block.data() + field.offset, sizeof value);
    return value;  // written with all digits that float32 needs
  }
  std::uint32_t value;
  std::memcpy(&value, block.data() + field.offset, sizeof value);
  return value;
}

}  // namespace

std::unique_ptr<Buffer> Recorder::createBuffer(std::size_t bytes, std::string_view name) {
  const auto before = std::ranges::count(buffers_, name, &BufferEntry::pipeline);
  std::string unique = before == 0 ? std::string(name) : fmt::format("{} {}", name, before + 1);
  buffers_.push_back({unique, std::string(name), bytes});
  return std::make_unique<RecordedBuffer>(devices::ForwardingDevice::createBuffer(bytes, name), std::move(unique));
}

void Recorder::write(Buffer& buffer, std::size_t offset, std::span<const std::byte> data) {
  const std::string& name = recorded(buffer).name;
  std::string stem = "buffers/" + name;
  std::ranges::replace(stem, ' ', '-');
  std::string file = stem + ".bin";
  for (int again = 2; files_.contains(file); ++again) file = fmt::format("{}-write-{}.bin", stem, again);
  files_[file].assign(data.begin(), data.end());
  commands_.push_back({{"do", "write"}, {"buffer", name}, {"offset", offset}, {"bytes", data.size()}, {"file", file}});
  devices::ForwardingDevice::write(*static_cast<RecordedBuffer&>(buffer).runs, offset, data);
}

void Recorder::read(const Buffer& buffer, std::size_t offset, std::span<std::byte> data) {
  commands_.push_back({{"do", "read"}, {"buffer", recorded(buffer).name}, {"offset", offset}, {"bytes", data.size()}});
  devices::ForwardingDevice::read(*recorded(buffer).runs, offset, data);
}

void Recorder::fill(Buffer& buffer, std::size_t offset, std::size_t bytes, std::uint32_t value) {
  commands_.push_back(
      {{"do", "fill"}, {"buffer", recorded(buffer).name}, {"offset", offset}, {"bytes", bytes}, {"word", value}});
  devices::ForwardingDevice::fill(*static_cast<RecordedBuffer&>(buffer).runs, offset, bytes, value);
}

void Recorder::dispatch(const Kernel& kernel, std::span<const Binding> bindings, std::span<const std::byte> block,
                        std::uint32_t groups) {
  std::vector<Binding> inner;
  Json bound = Json::object(), uniforms = Json::object();
  for (const Binding& binding : bindings) {
    inner.push_back({binding.name, recorded(*binding.buffer).runs.get()});
    bound[std::string(binding.name)] = recorded(*binding.buffer).name;
  }
  for (const auto& [name, field] : kernel.compiled().interface.fields) uniforms[name] = fieldValue(block, field);
  const std::uint32_t across = std::min(groups, kGroupRow), down = (groups + kGroupRow - 1) / kGroupRow;
  if (groups > 0)
    commands_.push_back({{"do", "dispatch"},
                         {"stage", kernel.compiled().stage},
                         {"groups", {across, down, 1}},
                         {"buffers", std::move(bound)},
                         {"uniforms", std::move(uniforms)}});
  devices::ForwardingDevice::dispatch(kernel, inner, block, groups);
}

}  // namespace tessera::cli
