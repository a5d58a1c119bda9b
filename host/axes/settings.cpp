#include "host/axes/settings.h"

namespace tessera {

Variant joined(Variant variant, const Variant& more) {
  for (const auto& [name, value] : more.values()) variant.set(name, value);
  return variant;
}

Variant counting(Variant variant) {
  variant.set("counters", "work");
  return variant;
}

}  // namespace tessera
