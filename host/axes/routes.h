// The routes from Slang to a machine: one list, which the axis `route`, the kernel cache and the devices read.
#pragma once

#include <tessera/kernel.h>
#include <tessera/variant.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tessera::axes {

/// The compiler that reads what slangc wrote.
enum class SecondCompiler { kNone, kCxx, kGlslang };

/// Bytes of group memory where a group is one thread. The memory lies on the thread's stack, which has more; a core's
/// cache of the second level has this much at least.
inline constexpr std::uint64_t kThreadGroupBytes = 256 << 10;

struct RouteInfo {
  Route route;
  std::string name;     ///< the value of the axis `route`
  std::string meaning;  ///< one line, for the list of axes
  std::string devices;  ///< which devices take it, as messages say it
  std::vector<std::string> slangFlags;  ///< slangc's arguments, without files and the entry point
  std::string written;                  ///< name of the file that slangc writes
  SecondCompiler then = SecondCompiler::kNone;
  std::string binary;  ///< name of the binary in an entry of the kernel cache
  /// The binary is a SPIR-V module: its entry point is `main`, its resources are descriptors of set 0, checkSpirv()
  /// judges it, and the driver compiles it further when a device first runs it. Else it is a shared object, in which
  /// the entry point keeps its name and the resources are members of one struct.
  bool spirv = false;
  bool takesGlsl = false;        ///< a user's kernel may be GLSL
  bool oneThreadGroups = false;  ///< a group of a kernel is one thread
  bool compiledChecks = false;   ///< KernelCache::Options::boundsChecks compiles checks of indices into the binary
};

/// All routes, in the order of the axis' values.
const std::vector<RouteInfo>& routes();
const RouteInfo& routeInfo(Route route);
/// Throws kUsage, naming the routes there are.
const RouteInfo& routeNamed(std::string_view name);

/// The axis `route`.
Axis routeAxis();

/// Whether a device that takes these routes (by name) fulfils what the value needs of a route. A value of the axis
/// `route` needs itself.
bool fulfils(const std::vector<std::string>& taken, const AxisValue& value);
/// For a value that needs something of a route: the devices that it is for, as messages say it.
std::string devicesFor(const AxisValue& value);

}  // namespace tessera::axes
