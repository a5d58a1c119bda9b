// What the pipeline has many of, and how many there are: the one place where the host works out sizes. A dispatch takes
// its number of groups from here, a buffer its bytes.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace tessera {

enum class Extent {
  kVertices,
  kVertexValues,  ///< floats of the stream in hand, for each vertex
  kTriangles,     ///< of the batch
  kPixels,        ///< of the band
  kValues,        ///< floats of the stream in hand, for each pixel of the band
  kTiles,         ///< of the band
  kTilesAndTotal,
  kPieceSlots,  ///< room for pieces
  kItems,       ///< room for items
  kWorkItems,   ///< once setup has counted slots and items
  kEntries,     ///< room for entries of bins
  kMaskWords,   ///< of all tiles
  kScanned,     ///< elements of a prefix sum
  kScannedAndTotal,
  kCounters,    ///< of the kernels
  kScanGroups,  ///< groups of a prefix sum, which are also the sums that it leaves for the next level
};

/// The value of a field of the uniform block, by name.
using UniformValue = std::function<std::uint64_t(std::string_view)>;

/// How many there are while the uniforms have these values.
std::uint64_t count(Extent extent, const UniformValue& uniform);
/// The same as a formula over the fields' names, e.g. "width * (rowEnd - rowBegin)"; a test holds it against count().
const std::string& formula(Extent extent);

inline std::uint64_t ceilDivide(std::uint64_t a, std::uint64_t b) { return (a + b - 1) / b; }

}  // namespace tessera
