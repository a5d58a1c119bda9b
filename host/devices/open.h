// What the host asks about devices by the names that people type. The kinds themselves: <tessera/device-kind.h>.
#pragma once

#include <tessera/device-kind.h>
#include <tessera/kernel.h>
#include <tessera/variant.h>

#include <string>
#include <string_view>
#include <vector>

namespace tessera::devices {

/// The kind of the device of that name, whether or not there is such a device here; null: no kind has such names.
const DeviceKind* findKind(std::string_view name);
/// The same. Throws kUsage where there is none, naming the devices here.
const DeviceKind& kindOf(const std::string& name);
/// Whether the device of that name runs on as many host threads as it is told.
bool takesThreads(std::string_view name);

/// The device of a command that names none.
std::string defaultDevice();
/// The name of each usable device here: "cpu", "vulkan:0", ...
std::vector<std::string> presentDevices();
/// The name that opens the device.
std::string nameOf(const DeviceKind& kind, const FoundDevice& device);

/// The names that there may be: "cpu, vulkan, vulkan:N or vulkan:NAME". `explained`: with what N and NAME are.
std::string deviceForms(bool explained = false);
/// The kinds' names alone.
std::vector<std::string> kindNames();

/// How kernels reach this device under this variant: as the variant says where the device takes that route, else by the
/// device's default route.
Route routeOf(const DeviceInfo& device, const Variant& variant);

}  // namespace tessera::devices
