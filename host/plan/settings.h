// A resolved variant as the host reads it: a typed value for each axis that decides what the host does.
#pragma once

#include <tessera/variant.h>

#include <cstdint>
#include <string>

namespace tessera {

inline constexpr std::uint32_t kBlock = 64;  ///< pixels; slang's blocks, and the tiles of a frame that has no bins

enum class Overflow { kRetry, kError, kDrop };

struct Settings {
  std::string binning;
  std::uint32_t tile = kBlock;  ///< pixels
  std::uint32_t capacity = 0;   ///< entries that a queue starts with
  Overflow overflow = Overflow::kRetry;
  bool clip = true, perspective = true, betweenSamples = true, compact = false;
  CommitTraits commit;
  LoopBound loops;  ///< of the traversal
  std::string cull, shade;
};

/// `resolved` has a value for every axis.
Settings settingsOf(const Variant& resolved);

}  // namespace tessera
