// makePlan() of <tessera/plan.h>, but for any set of binnings.
#pragma once

#include <tessera/plan.h>

#include "host/plan/bins.h"

namespace tessera::plan {

/// Plans as makePlan() does, with binnings from `binsOf`. Throws as makePlan() does.
Plan planFrame(const Scene& scene, const Variant& variant, const DeviceInfo& device, const BinsOf& binsOf);

}  // namespace tessera::plan
