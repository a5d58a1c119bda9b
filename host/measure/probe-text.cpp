#include "host/measure/probe-text.h"

#include "host/axes/routes.h"

namespace tessera::measure {

std::string routeName(Route route) { return axes::routeInfo(route).name; }

std::string verdictOf(const Probe& probe) {
  return probe.passed() ? "passed" : probe.onlyFlushes() ? "flushes denormals" : "FAILED";
}

std::string firstFailure(const Probe& probe) {
  for (const auto& result : probe.results)
    if (result.required && !result.passed) return result.name + ": " + result.detail;
  return "";
}

}  // namespace tessera::measure
