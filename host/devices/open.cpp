#include "host/devices/open.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tessera/error.h>

#include <algorithm>

#include "host/axes/routes.h"
#include "host/support/suggest.h"
#include "host/support/text.h"

namespace tessera {
namespace {

/// What stands after the kind's name and a colon; "" for the name alone.
std::string selectOf(const DeviceKind& kind, std::string_view name) {
  return std::string(name.substr(std::min(name.size(), kind.name.size() + 1)));
}

/// Which devices there are, and which of them may have been meant: a part of a device's name without its kind's, too.
[[noreturn]] void failDevice(const std::string& name) {
  std::vector<std::string> names, known;
  std::string part;
  for (const DeviceKind& kind : deviceKinds())
    for (const FoundDevice& device : kind.find().devices) {
      names.push_back(devices::nameOf(kind, device));
      known.push_back(device.select.empty() ? names.back() : fmt::format("{} ({})", names.back(), device.name));
      if (!kind.nickname.empty() && support::lowerCase(name) == kind.nickname) part = kind.name;
      if (kind.selects && !name.empty() &&
          support::lowerCase(device.name).find(support::lowerCase(name)) != std::string::npos)
        part = kind.name + ":" + name;
    }
  if (part.empty()) part = support::nearest(name, names);
  failUsage(fmt::format("--device {}: no such device; {}there {} {}", name,
                        part.empty() ? "" : fmt::format("did you mean {}? Otherwise ", part),
                        known.size() == 1 ? "is" : "are", fmt::join(known, ", ")));
}

}  // namespace

namespace devices {

std::string nameOf(const DeviceKind& kind, const FoundDevice& device) {
  return device.select.empty() ? kind.name : fmt::format("{}:{}", kind.name, device.select);
}

const DeviceKind* findKind(std::string_view name) {
  for (const DeviceKind& kind : deviceKinds())
    if (name == kind.name || (kind.selects && name.starts_with(kind.name + ":") && !selectOf(kind, name).empty()))
      return &kind;
  return nullptr;
}

const DeviceKind& kindOf(const std::string& name) {
  if (const DeviceKind* const kind = findKind(name)) return *kind;
  failDevice(name);
}

bool takesThreads(std::string_view name) {
  const DeviceKind* const kind = findKind(name);
  return kind != nullptr && kind->takesThreads;
}

}  // namespace devices

std::unique_ptr<Device> openDevice(const std::string& name, const DeviceOptions& options) {
  const DeviceKind& kind = devices::kindOf(name);
  DeviceOptions all = options;
#ifdef TESSERA_VALIDATION
  all.validation = true;
#endif
  std::unique_ptr<Device> device = kind.open(selectOf(kind, name), all);
  const DeviceInfo& info = device->info();
  const auto taken = [&](const std::string& route) { return std::ranges::count(kind.routes, route) > 0; };
  if (info.api != kind.name || info.routes.empty() || !std::ranges::all_of(info.routes, taken))
    fail(fmt::format("device {}: opened as '{}' with route {}; its kind is {}, which takes {}", name, info.api,
                     fmt::join(info.routes, ", "), kind.name, fmt::join(kind.routes, ", ")));
  return device;
}

namespace devices {

std::string defaultDevice() { return deviceKinds().front().name; }

std::vector<std::string> presentDevices() {
  std::vector<std::string> names;
  for (const DeviceKind& kind : deviceKinds())
    for (const FoundDevice& device : kind.find().devices)
      if (device.whyNot.empty()) names.push_back(nameOf(kind, device));
  return names;
}

std::string deviceForms(bool explained) {
  std::vector<std::string> forms = kindNames();
  for (const DeviceKind& kind : deviceKinds())
    if (kind.selects) {
      forms.push_back(kind.name + (explained ? ":N (its number in 'tessera devices')" : ":N"));
      forms.push_back(kind.name + (explained ? ":NAME (part of its name)" : ":NAME"));
    }
  const std::string last = forms.back();
  forms.pop_back();
  return forms.empty() ? last : fmt::format("{} or {}", fmt::join(forms, ", "), last);
}

std::vector<std::string> kindNames() { return support::namesOf(deviceKinds(), &DeviceKind::name); }

Route routeOf(const DeviceInfo& device, const Variant& variant) {
  const std::string asked = variant.get("route");
  return axes::routeNamed(std::ranges::count(device.routes, asked) > 0 ? asked : device.routes.front()).route;
}

}  // namespace devices

}  // namespace tessera
