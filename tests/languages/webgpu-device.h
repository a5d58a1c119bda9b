// A WebGPU device of wgpu-native on Vulkan, for the two programs here.
#pragma once

#include <webgpu.h>

#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

std::string complaint;  // the first

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
