#include "host/plan/settings.h"

namespace tessera::plan {

Settings settingsOf(const Variant& resolved) {
  const bool none = resolved.is("binning", "none");
  return {.binning = resolved.get("binning"),
          .tile = none ? kBlock : resolved.number("tile"),
          .capacity = resolved.number("capacity"),
          .overflow = resolved.is("overflow", "error")  ? Overflow::kError
                      : resolved.is("overflow", "drop") ? Overflow::kDrop
                                                        : Overflow::kRetry,
          .clip = resolved.isOn("clip"),
          .perspective = resolved.is("projection", "perspective"),
          .betweenSamples = resolved.isOn("between-samples"),
          .compact = resolved.isOn("compact"),
          .commit = commitTraits(resolved.get("commit")),
          .loops = loopBound(resolved),
          .cull = resolved.get("cull"),
          .shade = resolved.get("shade")};
}

}  // namespace tessera::plan
