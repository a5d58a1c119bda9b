#include "host/axes/settings.h"

#include <iterator>
#include <sstream>

namespace tessera::axes {

std::vector<std::string> settingsIn(std::string_view text) {
  std::istringstream words{std::string(text)};
  return {std::istream_iterator<std::string>(words), {}};
}

Variant joined(Variant variant, const Variant& more) {
  for (const auto& [name, value] : more.values()) variant.set(name, value);
  return variant;
}

Variant counting(Variant variant) {
  variant.set("counters", "work");
  return variant;
}

}  // namespace tessera::axes
