#include "host/plan/extent.h"

#include <fmt/format.h>
#include <tessera/counters.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace tessera::plan {
namespace {

constexpr std::uint64_t kScanBlock = 1024;  // elements that one group of a prefix sum takes: slang's scan has the same

struct Size {
  Extent extent;
  std::string formula;
  std::uint64_t (*count)(const UniformValue& of);
};

const Size& sizeOf(Extent extent) {
  static const std::vector<Size> list{
      {Extent::kVertices, "vertexCount", [](const UniformValue& of) { return of("vertexCount"); }},
      {Extent::kVertexValues, "components * vertexCount",
       [](const UniformValue& of) { return of("components") * of("vertexCount"); }},
      {Extent::kTriangles, "triangleCount", [](const UniformValue& of) { return of("triangleCount"); }},
      {Extent::kPixels, "width * (rowEnd - rowBegin)",
       [](const UniformValue& of) { return of("width") * (of("rowEnd") - of("rowBegin")); }},
      {Extent::kValues, "components * width * (rowEnd - rowBegin)",
       [](const UniformValue& of) { return of("components") * of("width") * (of("rowEnd") - of("rowBegin")); }},
      {Extent::kTiles, "tilesX * tilesY", [](const UniformValue& of) { return of("tilesX") * of("tilesY"); }},
      {Extent::kTilesAndTotal, "(tilesX * tilesY + 1)",
       [](const UniformValue& of) { return of("tilesX") * of("tilesY") + 1; }},
      {Extent::kPieceSlots, "(triangleCount + extraCapacity)",
       [](const UniformValue& of) { return of("triangleCount") + of("extraCapacity"); }},
      {Extent::kItems, "itemCapacity", [](const UniformValue& of) { return of("itemCapacity"); }},
      {Extent::kWorkItems, "(slotCount + itemCount)",
       [](const UniformValue& of) { return of("slotCount") + of("itemCount"); }},
      {Extent::kEntries, "entryCapacity", [](const UniformValue& of) { return of("entryCapacity"); }},
      {Extent::kMaskWords, "tilesX * tilesY * maskWords",
       [](const UniformValue& of) { return of("tilesX") * of("tilesY") * of("maskWords"); }},
      {Extent::kScanned, "scanCount", [](const UniformValue& of) { return of("scanCount"); }},
      {Extent::kScannedAndTotal, "(scanCount + 1)", [](const UniformValue& of) { return of("scanCount") + 1; }},
      {Extent::kScanGroups, "ceil(scanCount / 1024)",
       [](const UniformValue& of) { return ceilDivide(of("scanCount"), kScanBlock); }},
      {Extent::kCounters, fmt::format("{}", kernelCounterCount()),
       [](const UniformValue&) -> std::uint64_t { return kernelCounterCount(); }},
  };
  const auto found = std::ranges::find(list, extent, &Size::extent);
  if (found == list.end()) throw std::logic_error("an extent without a size");
  return *found;
}

}  // namespace

std::uint64_t count(Extent extent, const UniformValue& uniform) { return sizeOf(extent).count(uniform); }
const std::string& formula(Extent extent) { return sizeOf(extent).formula; }

}  // namespace tessera::plan
