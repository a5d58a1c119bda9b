// Words of text.
#pragma once

#include <string>
#include <string_view>

namespace tessera::support {

/// ASCII letters made small.
std::string lowerCase(std::string_view text);

/// The value of a variable of the environment; "" where it is not set.
std::string environment(const char* name);

}  // namespace tessera::support
