// A variant, as far as the oracle takes it.
#pragma once

#include <tessera/oracle.h>
#include <tessera/variant.h>

namespace tessera::oracle {

/// The image axes of a variant; an axis that is not set has its default.
ImageAxes imageAxesOf(const Variant& variant);

}  // namespace tessera::oracle
