// A kind of devices that the library knows nothing of: it writes down what it is asked and has the CPU device do it.
#pragma once

#include <tessera/device-kind.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace tessera::test {

/// What its devices were asked for, all of them together.
struct MirrorLog {
  std::vector<std::string> opened;  ///< "SELECT, N threads"
  std::size_t buffers = 0;
  std::vector<std::string> kernels;               ///< their stages, in the order of creation
  std::map<std::string, std::size_t> dispatches;  ///< by stage
};

/// A kind of one device.
DeviceKind mirrorKind(std::shared_ptr<MirrorLog> log, const std::string& name = "mirror");

}  // namespace tessera::test
