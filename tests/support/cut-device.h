// A device that says it is smaller than it is, so that the host has to cut a frame.
#pragma once

#include <tessera/device.h>

#include <memory>

namespace tessera::test {

/// `inner` with smaller limits (0: as they are). It refuses a buffer beyond its limit, as a real device of that size
/// would.
std::unique_ptr<Device> makeCutDevice(std::unique_ptr<Device> inner, std::uint64_t maxBufferBytes,
                                      std::uint32_t maxLoopIterations = 0);

}  // namespace tessera::test
