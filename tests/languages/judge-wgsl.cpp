// judge-wgsl FILE: whether a WebGPU implementation takes it. wgpu-native, with naga inside, validates the module and
// makes a compute pipeline from it within WebGPU's default limits. Silent where it does; else the first line of what it
// says.
#include <webgpu.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

namespace {

std::string complaint;  // the first

WGPUStringView view(const std::string& text) { return {text.data(), text.size()}; }

void onError(const WGPUDevice*, WGPUErrorType, WGPUStringView message, void*, void*) {
  if (complaint.empty()) complaint.assign(message.data, message.length);
}

template <typename Handle, typename Status>
void keep(Status, Handle handle, WGPUStringView, void* place, void*) {
  *static_cast<Handle*>(place) = handle;
}

WGPUDevice openDevice() {
  const WGPUInstance instance = wgpuCreateInstance(nullptr);
  WGPUAdapter adapter = nullptr;
  WGPURequestAdapterOptions options = WGPU_REQUEST_ADAPTER_OPTIONS_INIT;
  options.backendType = WGPUBackendType_Vulkan;
  WGPURequestAdapterCallbackInfo gotAdapter = WGPU_REQUEST_ADAPTER_CALLBACK_INFO_INIT;
  gotAdapter.mode = WGPUCallbackMode_AllowSpontaneous;
  gotAdapter.callback = keep<WGPUAdapter, WGPURequestAdapterStatus>;
  gotAdapter.userdata1 = &adapter;
  wgpuInstanceRequestAdapter(instance, &options, gotAdapter);
  if (adapter == nullptr) return nullptr;
  WGPUDevice device = nullptr;
  WGPUDeviceDescriptor descriptor = WGPU_DEVICE_DESCRIPTOR_INIT;
  descriptor.uncapturedErrorCallbackInfo.callback = onError;
  WGPURequestDeviceCallbackInfo gotDevice = WGPU_REQUEST_DEVICE_CALLBACK_INFO_INIT;
  gotDevice.mode = WGPUCallbackMode_AllowSpontaneous;
  gotDevice.callback = keep<WGPUDevice, WGPURequestDeviceStatus>;
  gotDevice.userdata1 = &device;
  wgpuAdapterRequestDevice(adapter, &descriptor, gotDevice);
  return device;
}

int leave(int code) {
  std::fflush(stdout);
  std::_Exit(code);  // drivers are not asked to unload in order
}

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
