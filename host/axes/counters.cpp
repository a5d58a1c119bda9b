#include <fmt/format.h>
#include <tessera/counters.h>
#include <tessera/error.h>

#include <algorithm>

namespace tessera {

const std::vector<CounterDoc>& counterDocs() {
  using enum CounterMerge;
  static const std::vector<CounterDoc> docs{
      {"badIndex", "triangles dropped: an index is out of range", true, false, kOnce},
      {"nonFinite", "triangles dropped: a clip coordinate is NaN or infinite", true, false, kOnce},
      {"clipped", "triangles that crossed a clip plane", true, false, kOnce},
      {"outside", "triangles dropped: clipping left nothing", true, false, kOnce},
      {"behind", "pieces dropped: w <= 0, or 1/w or the position not finite", true, false, kOnce},
      {"zeroArea", "pieces dropped: no area once snapped", true, false, kOnce},
      {"facing", "pieces dropped by cull", true, false, kOnce},
      {"betweenSamples", "pieces dropped: their bounding box holds no sample", true, false, kOnce},
      {"offScreen", "pieces dropped: no sample of the raster in their bounding box", true},
      {"pieces", "pieces that went on to binning or raster", true},
      {"extraPieces", "pieces beyond the first of their triangle", true},
      {"items", "64 x 64 blocks of pieces larger than that", true},
      {"overflowed", "bin entries that did not fit and were not retried (overflow=drop)", true},
      {"largestBin", "pieces in the fullest tile", true, false, kLargest},
      {"evaluations", "cells whose edge functions were evaluated, not stepped (counters=work)", true, true},
      {"looks", "cells and larger rectangles that the edges classified (counters=work)", true, true},
      {"tests", "samples tested against a triangle's edges (counters=work)", true, true},
      {"covered", "samples covered, each hit counted (counters=work)", true, true},
      {"atomics", "atomic operations on the frame (counters=work)", true, true},
      {"visited", "entries that tiles looked at: pieces in their bins, or all of them (counters=work)", true, true},
      {"submitted", "triangles of the scene", false},
      {"binned", "pairs of a piece and a tile", false},
      {"retries", "times a stage ran again with more room", false},
      {"batches", "parts that the triangles were cut into to fit the device's buffers", false, false, kLargest},
      {"bands", "parts that the raster was cut into to fit the device's buffers", false},
  };
  return docs;
}

std::size_t kernelCounterCount() {
  const auto& docs = counterDocs();
  return static_cast<std::size_t>(std::ranges::count_if(docs, [](const CounterDoc& d) { return d.inKernels; }));
}

const CounterDoc& counterDoc(std::string_view name) {
  const auto found = std::ranges::find(counterDocs(), name, &CounterDoc::name);
  if (found == counterDocs().end()) fail(fmt::format("nothing counts {}", name));
  return *found;
}

std::size_t counterIndex(std::string_view name) {
  const CounterDoc& doc = counterDoc(name);
  if (!doc.inKernels) fail(fmt::format("no kernel counts {}", name));
  return static_cast<std::size_t>(&doc - counterDocs().data());
}

}  // namespace tessera
