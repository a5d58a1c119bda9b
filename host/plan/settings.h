// A resolved variant as the host reads it: a typed value for each axis on which the host's work depends.
#pragma once

#include <tessera/variant.h>

#include <cstdint>
#include <string>

namespace tessera::plan {

inline constexpr std::uint32_t kBlock = 64;  ///< edge in pixels of slang's blocks, and of tiles where there are no bins

enum class Overflow { kRetry, kError, kDrop };

struct Settings {
  std::string binning;
  std::uint32_t tile = kBlock;  ///< edge of a tile, in pixels
  std::uint32_t capacity = 0;   ///< entries that a queue has room for at the start
  Overflow overflow = Overflow::kRetry;
  bool clip = true, perspective = true, betweenSamples = true, compact = false;
  CommitTraits commit;
  LoopBound loops;  ///< of the walk over the entries of a tile
  std::string cull, shade;
};

/// The settings of a resolved variant, which has a value for every axis.
Settings settingsOf(const Variant& resolved);

}  // namespace tessera::plan
