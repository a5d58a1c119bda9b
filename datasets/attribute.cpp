#include "datasets/attribute.h"

#include <fmt/format.h>
#include <tessera/error.h>

#include "host/support/suggest.h"

namespace tessera::datasets {

void failAttribute(const std::string& place, const std::string& name, const std::vector<std::string>& present) {
  failUsage(fmt::format("{}: no attribute '{}'; {}", place, name, support::whatThereIs(name, present)));
}

}  // namespace tessera::datasets
