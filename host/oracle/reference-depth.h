// The contract's section Depth.
#pragma once

#include <cstdint>

#include "host/oracle/reference-exact.h"

namespace tessera::oracle {

/// Depth of one piece in float32, in the stated order. Every integer difference below 2^25 is rounded once on its way
/// to float32.
class Depth {
 public:
  Depth(const Piece& piece, Interpolate interpolate);
  /// At the sample of pixel (i, j), kept within the piece.
  float at(std::int64_t i, std::int64_t j);

 private:
  float byCellPlane(std::int64_t i, std::int64_t j);
  float byPlane(std::int64_t i, std::int64_t j) const;
  float byWeights(Wide px, Wide py) const;

  const Piece& piece_;
  Interpolate interpolate_;
  float r_, d1_, d2_, zx_ = 0, zy_ = 0, zmin_ = 0, zmax_ = 0;
  std::int64_t column_ = -1, row_ = -1;  // of the cell that zc_ was computed for
  float zc_ = 0;
};

/// Depth of the snapped piece at a covered sample, right to about 2^-112 of itself.
Exact exactDepth(const Piece& piece, std::int64_t i, std::int64_t j);

}  // namespace tessera::oracle
