// Kinds of devices: what each is called, how its devices are found and how one is opened. A program adds a kind of its
// own by registerDevice(); every command, sweep and plan then knows that kind as it knows the built-in ones.
#pragma once

#include <tessera/device.h>

#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tessera {

/// What a device is opened with. A kind ignores what it does not take.
struct DeviceOptions {
  unsigned threads = 0;       ///< host threads that run kernels, 0: one a core; see DeviceKind::takesThreads
  bool boundsChecks = false;  ///< the device checks each index of a kernel; see DeviceKind::checksBounds
  bool validation = false;    ///< the driver checks how the device uses it, where the driver can
};

/// A device that a kind has found on this machine.
struct FoundDevice {
  /// What opens it: the kind's name, a colon and this text, e.g. "0" for "vulkan:0". Empty: the kind's name alone.
  std::string select;
  std::string name;    ///< as DeviceInfo::name, e.g. "llvmpipe (LLVM 15.0.6, 256 bits)"
  std::string driver;  ///< the driver's name and version; empty where that is known of an open device alone
  std::string whyNot;  ///< why the device cannot be used, one line; empty: the device can be used
};

/// The devices of a kind on this machine.
struct FoundDevices {
  std::vector<FoundDevice> devices;  ///< usable ones and others, in the driver's order
  std::vector<std::string> notes;    ///< what kept a driver from loading, one line each
};

/// A kind of devices, e.g. all devices that Vulkan reaches.
struct DeviceKind {
  /// What people type, and DeviceInfo::api of its devices, e.g. "vulkan": lower-case letters, digits and hyphens.
  std::string name;
  std::string title;          ///< the kind's name in a sentence, e.g. "CPU" in "the CPU device"
  std::string meaning;        ///< what the name alone opens, in a few words
  std::string nickname = {};  ///< another word that people type by mistake, e.g. "gpu": messages then name this kind
  std::vector<std::string>
      routes;            ///< values of the axis `route` that its devices take, at least one; first the default
  bool selects = false;  ///< "NAME:N" and "NAME:PART" open one device of several, by its number or part of its name
  bool takesThreads = false;  ///< its devices run on as many host threads as DeviceOptions::threads says
  /// Its devices check indices themselves, as DeviceOptions::boundsChecks asks. Else the checks have to be compiled
  /// into the kernels: KernelCache::Options::boundsChecks.
  bool checksBounds = false;
  /// Lists the devices on this machine. Does not throw where there is no driver: a note says so.
  std::function<FoundDevices()> find;
  /// Opens the device that `select` names, "" the best one. Throws kUsage where there is no such device. The device's
  /// info has `name` as its api and at least one of `routes`.
  std::function<std::unique_ptr<Device>(const std::string& select, const DeviceOptions& options)> open;
};

/// Adds a kind, which openDevice() and deviceKinds() know from then on. Throws kUsage where the kind's name is taken or
/// not a name, a route is not a value of the axis `route`, or a function is missing. Not thread-safe: a program
/// registers its kinds before it does anything else.
void registerDevice(DeviceKind kind);

/// All kinds: first the built-in ones, then those that were registered, in their order. The first kind is what a
/// command runs on that names no device.
const std::deque<DeviceKind>& deviceKinds();

/// Opens the device that people call `name`: a kind's name, e.g. "cpu" or "vulkan", and where the kind selects,
/// "vulkan:N" (the number that `tessera devices` has for it) or "vulkan:NAME" (part of its name). Throws kUsage for a
/// name that no device has, with the names of the devices here.
std::unique_ptr<Device> openDevice(const std::string& name, const DeviceOptions& options = {});

}  // namespace tessera
