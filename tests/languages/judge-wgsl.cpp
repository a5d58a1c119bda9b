// judge-wgsl FILE: whether a WebGPU implementation takes it. wgpu-native, with naga inside, validates the module and
// makes a compute pipeline from it within WebGPU's default limits. Silent where it does; else the first line of what it
// says.
#include <webgpu.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>

#include "webgpu-device.h"

namespace {

WGPUStringView view(const std::string& text) { return {text.data(), text.size()}; }

}  // namespace

int main(int argc, char** argv) {
  std::ifstream file(argc == 2 ? argv[1] : "");
  if (!file) return std::puts("usage: judge-wgsl FILE"), 2;
  const std::string code{std::istreambuf_iterator<char>(file), {}};
  const WGPUDevice device = openDevice();
  if (device == nullptr) return std::puts("no Vulkan device for WebGPU"), leave(2);

  WGPUShaderSourceWGSL source = WGPU_SHADER_SOURCE_WGSL_INIT;
  source.code = view(code);
  WGPUShaderModuleDescriptor module = WGPU_SHADER_MODULE_DESCRIPTOR_INIT;
  module.nextInChain = &source.chain;
  const WGPUShaderModule made = wgpuDeviceCreateShaderModule(device, &module);
  if (complaint.empty()) {
    WGPUComputePipelineDescriptor pipeline = WGPU_COMPUTE_PIPELINE_DESCRIPTOR_INIT;
    pipeline.compute.module = made;
    wgpuDeviceCreateComputePipeline(device, &pipeline);
  }
  if (complaint.empty()) return leave(0);
  // "Validation Error", then "Caused by:" and the reason, a line each and further in.
  std::replace(complaint.begin(), complaint.end(), '\n', ' ');
  std::puts(complaint.c_str());
  return leave(1);
}
