#pragma once

#include <tessera/input.h>

#include <string>
#include <vector>

namespace tessera::datasets {

inline const std::vector<std::string> kCoordinates{"x", "y", "z"};  ///< what every mesh has

/// Refuses an attribute, naming those that there are.
[[noreturn]] void failAttribute(const std::string& place, const std::string& name,
                                const std::vector<std::string>& present);

}  // namespace tessera::datasets
