// What this machine is called.
#pragma once

#include <string>

namespace tessera::support {

/// The model of the first processor, as Linux names it; "CPU" where it names none.
std::string processorName();

}  // namespace tessera::support
