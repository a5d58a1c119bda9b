// run-wgsl FOLDER: runs the kernels in it on a WebGPU device, knowing what its manifest.json says and nothing of
// Tessera. Each output of the frame comes into FOLDER/NAME.out.
#include <webgpu.h>
#include <wgpu.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "webgpu-device.h"

namespace {

using Json = nlohmann::json;
using Bytes = std::vector<char>;

Bytes readFile(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) std::printf("%s: cannot be read\n", path.c_str()), leave(2);
  return {std::istreambuf_iterator<char>(file), {}};
}

constexpr std::size_t roundUp(std::size_t bytes, std::size_t to) { return (bytes + to - 1) / to * to; }

struct Stage {
  WGPUComputePipeline pipeline;
  WGPUBindGroupLayout layout;
  const Json* json;
};

class Host {
 public:
  Host(std::string folder, WGPUDevice device)
      : folder_(std::move(folder)), device_(device), queue_(wgpuDeviceGetQueue(device)) {
    const Bytes text = readFile(folder_ + "/manifest.json");
    manifest_ = Json::parse(text.begin(), text.end());
    for (const Json& stage : manifest_.at("stages")) stages_[stage.at("stage")] = stageOf(stage);
    for (const Json& buffer : manifest_.at("buffers"))
      buffers_[buffer.at("name")] =
          makeBuffer(buffer.at("bytes"), WGPUBufferUsage_Storage | WGPUBufferUsage_CopyDst | WGPUBufferUsage_CopySrc);
  }

  void run() {
    for (const Json& command : manifest_.at("commands")) {
      const std::string what = command.at("do");
      if (what == "write") {
        const Bytes data = readFile(folder_ + "/" + command.at("file").get<std::string>());
        put(buffers_.at(command.at("buffer")), command.at("offset"), data);
      } else if (what == "fill") {
        const std::vector<std::uint32_t> words(command.at("bytes").get<std::size_t>() / 4, command.at("word"));
        Bytes data(words.size() * 4);
        std::memcpy(data.data(), words.data(), data.size());
        put(buffers_.at(command.at("buffer")), command.at("offset"), data);
      } else if (what == "dispatch") {
        dispatch(command);
      }
    }
    for (const auto& [name, output] : manifest_.at("outputs").items()) {
      const Bytes data = get(buffers_.at(output.at("buffer")));
      std::ofstream(folder_ + "/" + name + ".out", std::ios::binary)
          .write(data.data(), static_cast<std::streamsize>(data.size()));
    }
  }

 private:
  struct Buffer {
    WGPUBuffer handle;
    std::size_t bytes, room;
  };

  Buffer makeBuffer(std::size_t bytes, WGPUBufferUsage usage) {
    WGPUBufferDescriptor descriptor = WGPU_BUFFER_DESCRIPTOR_INIT;
    descriptor.size = roundUp(std::max<std::size_t>(bytes, 16), 16);
    descriptor.usage = usage;
    return {wgpuDeviceCreateBuffer(device_, &descriptor), bytes, descriptor.size};
  }

  Stage stageOf(const Json& json) {
    const Bytes code = readFile(folder_ + "/" + json.at("file").get<std::string>());
    WGPUShaderSourceWGSL source = WGPU_SHADER_SOURCE_WGSL_INIT;
    source.code = {code.data(), code.size()};
    WGPUShaderModuleDescriptor module = WGPU_SHADER_MODULE_DESCRIPTOR_INIT;
    module.nextInChain = &source.chain;
    std::vector<WGPUBindGroupLayoutEntry> entries;
    const auto add = [&](const Json& resource, WGPUBufferBindingType type) {
      WGPUBindGroupLayoutEntry entry = WGPU_BIND_GROUP_LAYOUT_ENTRY_INIT;
      entry.binding = resource.at("place").at("binding");
      entry.visibility = WGPUShaderStage_Compute;
      entry.buffer.type = type;
      entries.push_back(entry);
    };
    if (!json.at("uniforms").is_null()) add(json.at("uniforms"), WGPUBufferBindingType_Uniform);
    for (const Json& binding : json.at("bindings"))
      add(binding,
          binding.at("access") == "read" ? WGPUBufferBindingType_ReadOnlyStorage : WGPUBufferBindingType_Storage);
    WGPUBindGroupLayoutDescriptor layout = WGPU_BIND_GROUP_LAYOUT_DESCRIPTOR_INIT;
    layout.entryCount = entries.size();
    layout.entries = entries.data();
    Stage stage{nullptr, wgpuDeviceCreateBindGroupLayout(device_, &layout), &json};
    WGPUPipelineLayoutDescriptor whole = WGPU_PIPELINE_LAYOUT_DESCRIPTOR_INIT;
    whole.bindGroupLayoutCount = 1;
    whole.bindGroupLayouts = &stage.layout;
    const std::string entry = json.at("entryPoint");
    WGPUComputePipelineDescriptor pipeline = WGPU_COMPUTE_PIPELINE_DESCRIPTOR_INIT;
    pipeline.layout = wgpuDeviceCreatePipelineLayout(device_, &whole);
    pipeline.compute.module = wgpuDeviceCreateShaderModule(device_, &module);
    pipeline.compute.entryPoint = {entry.data(), entry.size()};
    stage.pipeline = wgpuDeviceCreateComputePipeline(device_, &pipeline);
    return stage;
  }

  void put(const Buffer& buffer, std::size_t offset, Bytes data) {
    data.resize(roundUp(data.size(), 4));
    wgpuQueueWriteBuffer(queue_, buffer.handle, offset, data.data(), data.size());
  }

  /// The uniform block, each field at its place.
  Bytes blockOf(const Json& uniforms, const Json& values) {
    Bytes block(roundUp(uniforms.at("bytes").get<std::size_t>(), 16));
    for (const Json& field : uniforms.at("fields")) {
      const Json& value = values.at(field.at("name").get<std::string>());
      char* const to = block.data() + field.at("offset").get<std::size_t>();
      if (field.at("type") == "f32") {
        const float number = value;
        std::memcpy(to, &number, 4);
      } else {
        const std::uint32_t number = value;
        std::memcpy(to, &number, 4);
      }
    }
    return block;
  }

  void dispatch(const Json& command) {
    const Stage& stage = stages_.at(command.at("stage"));
    std::vector<WGPUBindGroupEntry> entries;
    const auto add = [&](const Json& resource, const Buffer& buffer) {
      WGPUBindGroupEntry entry = WGPU_BIND_GROUP_ENTRY_INIT;
      entry.binding = resource.at("place").at("binding");
      entry.buffer = buffer.handle;
      entry.size = buffer.room;
      entries.push_back(entry);
    };
    if (const Json& uniforms = stage.json->at("uniforms"); !uniforms.is_null()) {
      const Bytes block = blockOf(uniforms, command.at("uniforms"));
      const Buffer buffer = makeBuffer(block.size(), WGPUBufferUsage_Uniform | WGPUBufferUsage_CopyDst);
      put(buffer, 0, block);
      add(uniforms, buffer);
    }
    for (const Json& binding : stage.json->at("bindings"))
      add(binding, buffers_.at(command.at("buffers").at(binding.at("name").get<std::string>())));
    WGPUBindGroupDescriptor group = WGPU_BIND_GROUP_DESCRIPTOR_INIT;
    group.layout = stage.layout;
    group.entryCount = entries.size();
    group.entries = entries.data();
    const WGPUCommandEncoder encoder = wgpuDeviceCreateCommandEncoder(device_, nullptr);
    const WGPUComputePassEncoder pass = wgpuCommandEncoderBeginComputePass(encoder, nullptr);
    wgpuComputePassEncoderSetPipeline(pass, stage.pipeline);
    wgpuComputePassEncoderSetBindGroup(pass, 0, wgpuDeviceCreateBindGroup(device_, &group), 0, nullptr);
    const Json& groups = command.at("groups");
    wgpuComputePassEncoderDispatchWorkgroups(pass, groups.at(0), groups.at(1), groups.at(2));
    wgpuComputePassEncoderEnd(pass);
    submit(encoder);
  }

  void submit(WGPUCommandEncoder encoder) {
    const WGPUCommandBuffer commands = wgpuCommandEncoderFinish(encoder, nullptr);
    wgpuQueueSubmit(queue_, 1, &commands);
  }

  Bytes get(const Buffer& buffer) {
    const Buffer mapped = makeBuffer(buffer.room, WGPUBufferUsage_MapRead | WGPUBufferUsage_CopyDst);
    const WGPUCommandEncoder encoder = wgpuDeviceCreateCommandEncoder(device_, nullptr);
    wgpuCommandEncoderCopyBufferToBuffer(encoder, buffer.handle, 0, mapped.handle, 0, buffer.room);
    submit(encoder);
    WGPUBufferMapCallbackInfo callback = WGPU_BUFFER_MAP_CALLBACK_INFO_INIT;
    callback.mode = WGPUCallbackMode_AllowSpontaneous;
    callback.callback = [](WGPUMapAsyncStatus, WGPUStringView, void*, void*) {};
    wgpuBufferMapAsync(mapped.handle, WGPUMapMode_Read, 0, buffer.room, callback);
    wgpuDevicePoll(device_, true, nullptr);
    const auto* const data = static_cast<const char*>(wgpuBufferGetConstMappedRange(mapped.handle, 0, buffer.room));
    return data == nullptr ? Bytes() : Bytes(data, data + buffer.bytes);
  }

  std::string folder_;
  WGPUDevice device_;
  WGPUQueue queue_;
  Json manifest_;
  std::map<std::string, Stage> stages_;
  std::map<std::string, Buffer> buffers_;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return std::puts("usage: run-wgsl FOLDER"), 2;
  const WGPUDevice device = openDevice();
  if (device == nullptr) return std::puts("no Vulkan device for WebGPU"), leave(2);
  Host(argv[1], device).run();
  if (complaint.empty()) return leave(0);
  std::puts(complaint.c_str());
  return leave(1);
}
