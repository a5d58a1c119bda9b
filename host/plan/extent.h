// What the pipeline has many of, and how many there are. The host works out sizes in this place alone: the number of
// groups of a dispatch and the number of bytes of a buffer come from here.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace tessera::plan {

/// What there are many of.
enum class Extent {
  kVertices,         ///< vertices of the scene
  kVertexValues,     ///< floats of the current stream, over all vertices
  kTriangles,        ///< triangles of the batch
  kPixels,           ///< pixels of the band
  kValues,           ///< floats of the current stream, over all pixels of the band
  kTiles,            ///< tiles of the band
  kTilesAndTotal,    ///< tiles of the band, and one more for the total
  kPieceSlots,       ///< slots for which there is room
  kItems,            ///< items for which there is room
  kWorkItems,        ///< work items; known when setup has counted slots and items
  kEntries,          ///< entries of bins for which there is room
  kMaskWords,        ///< words of the masks of all tiles
  kScanned,          ///< elements of a prefix sum
  kScannedAndTotal,  ///< elements of a prefix sum, and one more for the total
  kCounters,         ///< counters of the kernels
  kScanGroups,       ///< groups of a prefix sum; each group leaves one sum for the next level
};

/// Gives the value of a field of the uniform block, by the field's name.
using UniformValue = std::function<std::uint64_t(std::string_view)>;

/// How many elements the extent has while the uniforms have these values.
std::uint64_t count(Extent extent, const UniformValue& uniform);
/// The number of elements as a formula over the fields' names, e.g. "width * (rowEnd - rowBegin)". A test holds the
/// formula against count().
const std::string& formula(Extent extent);

/// a / b, rounded up.
inline std::uint64_t ceilDivide(std::uint64_t a, std::uint64_t b) { return (a + b - 1) / b; }

}  // namespace tessera::plan
