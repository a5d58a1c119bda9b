// The arithmetic probe's verdict, in words.
#pragma once

#include <tessera/kernel.h>
#include <tessera/probe.h>

#include <string>

namespace tessera::measure {

std::string routeName(Route route);            ///< as on the axis `route`
std::string verdictOf(const Probe& probe);     ///< "passed", "flushes denormals" or "FAILED"
std::string firstFailure(const Probe& probe);  ///< "divide: 1/3 gives ..."; "" when it passed

}  // namespace tessera::measure
