#include "host/plan/buffers.h"

#include <fmt/format.h>
#include <tessera/error.h>

#include <algorithm>

#include "host/support/suggest.h"

namespace tessera::plan {

const std::vector<BufferDoc>& buffers() {
  using enum ChannelType;
  static const std::vector<BufferDoc> list{
      {"positions", 12, Extent::kVertices},
      {"clipSpace", 16, Extent::kVertices},
      {"corners", 16, Extent::kVertices},  // layout.slang: Corner
      {"attribute", 4, Extent::kVertexValues},
      {"triangles", 12, Extent::kTriangles},
      {"payloads", 4, Extent::kTriangles},
      {"pieces", 40, Extent::kPieceSlots},  // layout.slang: Piece
      {"items", 8, Extent::kItems},         // layout.slang: Item
      {"tileCounts", 4, Extent::kTiles},
      {"offsets", 4, Extent::kTilesAndTotal},
      {"entries", 4, Extent::kEntries},
      {"masks", 4, Extent::kMaskWords},
      {"counters", 8, Extent::kCounters},
      {"scanIn", 4, Extent::kScanned},
      {"scanOut", 4, Extent::kScannedAndTotal},
      {"scanSums", 4, Extent::kScanGroups},
      {"ids", 4, Extent::kPixels, ChannelDoc{kUint32, 1, "u32", "4294967295"}},
      {"depth", 4, Extent::kPixels, ChannelDoc{kFloat32, 1, "f32, as bits", "1.0"}},
      {"hits", 4, Extent::kPixels, ChannelDoc{kUint32, 1, "u32", "0"}},
      {"packed", 8, Extent::kPixels},
      {"packed32", 4, Extent::kPixels},
      {"locks", 4, Extent::kPixels},
      {"colour", 12, Extent::kPixels, ChannelDoc{kFloat32, 3, "3 x f32, linear", "1.0"}},
      {"values", 4, Extent::kValues, ChannelDoc{kFloat32, 0, "f32, as bits", "NaN"}},
  };
  return list;
}

const BufferDoc* findBuffer(std::string_view name) {
  const auto found = std::ranges::find(buffers(), name, &BufferDoc::name);
  return found == buffers().end() ? nullptr : &*found;
}

const BufferDoc& bufferDoc(std::string_view name) {
  const BufferDoc* const found = findBuffer(name);
  if (found == nullptr)
    fail(fmt::format("no buffer is called `{}`; {}", name,
                     support::whatThereIs(name, support::namesOf(buffers(), &BufferDoc::name))));
  return *found;
}

bool isOfPixels(const BufferDoc& buffer) {
  return buffer.extent == Extent::kPixels || buffer.extent == Extent::kValues;
}

}  // namespace tessera::plan
