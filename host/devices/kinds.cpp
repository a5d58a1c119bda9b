#include "host/devices/kinds.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tessera/error.h>

#include <algorithm>

#include "host/axes/routes.h"
#include "host/support/suggest.h"

namespace tessera {
namespace {

/// The list of kinds. A function's, so that it is there for programs that register kinds before main() begins.
std::deque<DeviceKind>& kinds() {
  static std::deque<DeviceKind> list{devices::cpuKind(), devices::vulkanKind()};
  return list;
}

/// A name becomes a part of names of files and folders, and of "NAME:N".
bool isName(const std::string& name) {
  return !name.empty() && name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-") == std::string::npos &&
         name.front() != '-';
}

}  // namespace

void registerDevice(DeviceKind kind) {
  if (!isName(kind.name))
    failUsage(fmt::format("device kind '{}': not a name; lower-case letters, digits and hyphens would be", kind.name));
  if (std::ranges::count(kinds(), kind.name, &DeviceKind::name) > 0)
    failUsage(fmt::format("device kind {}: there is one of that name; another name would do", kind.name));
  if (kind.routes.empty())
    failUsage(fmt::format("device kind {}: it takes no route; one or more of {} would do", kind.name,
                          fmt::join(support::namesOf(axes::routes(), &axes::RouteInfo::name), ", ")));
  for (const std::string& route : kind.routes) try {
      axes::routeNamed(route);
    } catch (const Error& error) {
      throw Error(error.code(), fmt::format("device kind {}: {}", kind.name, error.what()));
    }
  if (!kind.find || !kind.open)
    failUsage(
        fmt::format("device kind {}: `{}` is empty; a function would do", kind.name, kind.find ? "open" : "find"));
  kinds().push_back(std::move(kind));
}

const std::deque<DeviceKind>& deviceKinds() { return kinds(); }

}  // namespace tessera
