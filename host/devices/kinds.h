// The built-in kinds of devices, which kinds.cpp lists.
#pragma once

#include <tessera/device-kind.h>

namespace tessera::devices {

DeviceKind cpuKind();     ///< host/devices/cpu
DeviceKind vulkanKind();  ///< host/devices/vulkan

}  // namespace tessera::devices
