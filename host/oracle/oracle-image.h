// A variant, as far as the oracle takes it.
#pragma once

#include <tessera/oracle.h>
#include <tessera/variant.h>

namespace tessera {

/// The image axes of a variant; an axis that is not set has its default.
reference::ImageAxes imageAxesOf(const Variant& variant);

}  // namespace tessera
