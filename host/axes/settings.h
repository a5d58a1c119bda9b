// Variants as text, and those made of other ones.
#pragma once

#include <tessera/variant.h>

#include <string>
#include <string_view>
#include <vector>

namespace tessera::axes {

/// The settings in "axis=value axis=value": what stands between blanks, of which no value holds one.
std::vector<std::string> settingsIn(std::string_view text);

/// `variant` with the settings of `more`, which win.
Variant joined(Variant variant, const Variant& more);

/// The variant that counts work, too: counters=work.
Variant counting(Variant variant);

}  // namespace tessera::axes
