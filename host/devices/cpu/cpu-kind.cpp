#include <tessera/cpu-device.h>

#include "host/devices/kinds.h"
#include "host/support/machine.h"

namespace tessera::devices {

DeviceKind cpuKind() {
  return {.name = "cpu",
          .title = "CPU",
          .meaning = "every core",
          .routes = {"cpp"},
          .takesThreads = true,
          .find =
              [] {
                return FoundDevices{
                    .devices = {{.select = "", .name = support::processorName(), .driver = "", .whyNot = ""}},
                    .notes = {}};
              },
          .open = [](const std::string&,
                     const DeviceOptions& options) { return makeCpuDevice({.threads = options.threads}); }};
}

}  // namespace tessera::devices
