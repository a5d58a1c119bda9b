// makePlan() of <tessera/plan.h>, for any set of binnings.
#pragma once

#include <tessera/plan.h>

#include "host/plan/bins.h"

namespace tessera {

Plan planFrame(const Scene& scene, const Variant& variant, const DeviceInfo& device, const BinsOf& binsOf);

}  // namespace tessera
