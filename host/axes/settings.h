// Variants made of other ones.
#pragma once

#include <tessera/variant.h>

namespace tessera {

/// `variant` with the settings of `more`, which win.
Variant joined(Variant variant, const Variant& more);

/// The variant that counts work, too: counters=work.
Variant counting(Variant variant);

}  // namespace tessera
