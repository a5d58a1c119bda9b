// A variant, as far as the oracle takes it.
#pragma once

#include <tessera/oracle.h>
#include <tessera/variant.h>

namespace tessera {

/// The oracle's image for the axes that define one; an axis that is not set has its default.
reference::Image imageOf(const Variant& variant);

}  // namespace tessera
