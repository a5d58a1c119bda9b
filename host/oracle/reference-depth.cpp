#include "host/oracle/reference-depth.h"

#include <algorithm>
#include <tuple>

namespace tessera::oracle {
namespace {

constexpr int kCell = 8;  // pixels

}  // namespace

Depth::Depth(const Piece& t, Interpolate interpolate)
    : piece_(t),
      interpolate_(interpolate),
      r_(1.0f / static_cast<float>(edge(t, 0, 1, t.x[2], t.y[2]))),
      d1_(t.z[1] - t.z[0]),
      d2_(t.z[2] - t.z[0]) {
  const auto slope = [&](std::int32_t difference) { return (static_cast<float>(difference) * 256.0f) * r_; };
  zx_ = slope(t.y[2] - t.y[0]) * d1_ + slope(t.y[0] - t.y[1]) * d2_;
  zy_ = slope(t.x[0] - t.x[2]) * d1_ + slope(t.x[1] - t.x[0]) * d2_;
  std::tie(zmin_, zmax_) = std::minmax({t.z[0], t.z[1], t.z[2]});
}

float Depth::at(std::int64_t i, std::int64_t j) {
  float z = interpolate_ == Interpolate::kPlane     ? byPlane(i, j)
            : interpolate_ == Interpolate::kWeights ? byWeights(sampleAt(i), sampleAt(j))
                                                    : byCellPlane(i, j);
  z = (z > zmin_) ? z : zmin_;
  return (z < zmax_) ? z : zmax_;
}

float Depth::byWeights(Wide px, Wide py) const {
  const float e20 = static_cast<float>(edge(piece_, 2, 0, px, py));
  const float e01 = static_cast<float>(edge(piece_, 0, 1, px, py));
  return piece_.z[0] + ((e20 * r_) * d1_ + (e01 * r_) * d2_);
}

float Depth::byCellPlane(std::int64_t i, std::int64_t j) {
  if (i / kCell != column_ || j / kCell != row_) {
    column_ = i / kCell;
    row_ = j / kCell;
    zc_ = byWeights(sampleAt(kCell * column_), sampleAt(kCell * row_));
  }
  return (zc_ + zx_ * static_cast<float>(i % kCell)) + zy_ * static_cast<float>(j % kCell);
}

float Depth::byPlane(std::int64_t i, std::int64_t j) const {
  const auto pixels = [](Wide difference) { return static_cast<float>(difference) / 256.0f; };  // exact division
  return (piece_.z[0] + zx_ * pixels(sampleAt(i) - piece_.x[0])) + zy_ * pixels(sampleAt(j) - piece_.y[0]);
}

// The mean of the vertices' depths weighted by exact edge functions. All terms are >= 0, and each product of 52 and 24
// bits is exact in 113.
Exact exactDepth(const Piece& t, std::int64_t i, std::int64_t j) {
  const auto weight = [&](int a, int b) { return static_cast<Exact>(edge(t, a, b, sampleAt(i), sampleAt(j))); };
  const Exact w0 = weight(1, 2), w1 = weight(2, 0), w2 = weight(0, 1);
  return (w0 * t.z[0] + w1 * t.z[1] + w2 * t.z[2]) / (w0 + w1 + w2);
}

}  // namespace tessera::oracle
