// The contract's sections Cover, Depth and Visible.
#include "host/reference.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace tessera::reference {
namespace {

using Wide = __int128;  // products of edge functions stay below 2^60; 128 bits leave no bound to prove
#ifdef __SIZEOF_FLOAT128__
using Exact = __float128;  // 113 bits
#else
using Exact = long double;  // binary128 where there is no __float128 (AArch64)
#endif

constexpr int kCell = 8;  // pixels

Wide sampleAt(std::int64_t pixel) { return Wide{256} * pixel + 128; }

// E_ab(p) of the contract: positive to the right of a->b on the screen, which is inside.
Wide edge(const Piece& t, int a, int b, Wide px, Wide py) {
  return Wide{t.x[b] - t.x[a]} * (py - t.y[a]) - Wide{t.y[b] - t.y[a]} * (px - t.x[a]);
}

bool isTopOrLeft(const Piece& t, int a, int b) { return (t.y[b] == t.y[a] && t.x[b] > t.x[a]) || t.y[b] < t.y[a]; }

Wide floorDivide(Wide a, Wide b) {  // b > 0
  const Wide q = a / b;
  return q * b > a ? q - 1 : q;
}
Wide ceilDivide(Wide a, Wide b) { return -floorDivide(-a, b); }

struct Range {
  std::int64_t first, last;  ///< inclusive; empty when first > last
};

// The columns of one row that one edge lets through: E is linear in the column i, E = base + slope i, so E >= least is
// solved for i with one exact division instead of being asked of each pixel.
Range columnsInside(const Piece& t, int a, int b, std::int64_t row, Range within) {
  const Wide base = edge(t, a, b, sampleAt(0), sampleAt(row));
  const Wide slope = Wide{t.y[a] - t.y[b]} * 256;
  const Wide least = isTopOrLeft(t, a, b) ? 0 : 1;
  if (slope > 0)
    within.first = static_cast<std::int64_t>(std::max<Wide>(within.first, ceilDivide(least - base, slope)));
  if (slope < 0)
    within.last = static_cast<std::int64_t>(std::min<Wide>(within.last, floorDivide(base - least, -slope)));
  if (slope == 0 && base < least) within.last = within.first - 1;
  return within;
}

Range coveredColumns(const Piece& t, std::int64_t row, std::uint32_t width) {
  Range range{0, std::int64_t{width} - 1};
  for (int a = 0; a < 3 && range.first <= range.last; ++a) range = columnsInside(t, a, (a + 1) % 3, row, range);
  return range;
}

Range coveredRows(const Piece& t, std::uint32_t height) {
  const auto [least, most] = std::minmax({t.y[0], t.y[1], t.y[2]});
  return {static_cast<std::int64_t>(std::max<Wide>(0, ceilDivide(least - 128, 256))),
          static_cast<std::int64_t>(std::min<Wide>(Wide{height} - 1, floorDivide(most - 128, 256)))};
}

// float32 in the stated order. Every integer difference below 2^25 is rounded once on its way to float32.
class DepthPlane {
 public:
  explicit DepthPlane(const Piece& t)
      : piece_(t),
        r_(1.0f / static_cast<float>(edge(t, 0, 1, t.x[2], t.y[2]))),
        d1_(t.z[1] - t.z[0]),
        d2_(t.z[2] - t.z[0]) {
    const auto slope = [&](std::int32_t difference) { return (static_cast<float>(difference) * 256.0f) * r_; };
    zx_ = slope(t.y[2] - t.y[0]) * d1_ + slope(t.y[0] - t.y[1]) * d2_;
    zy_ = slope(t.x[0] - t.x[2]) * d1_ + slope(t.x[1] - t.x[0]) * d2_;
    std::tie(zmin_, zmax_) = std::minmax({t.z[0], t.z[1], t.z[2]});
  }

  /// Depth at the first pixel of the 8 x 8 cell that holds pixel (i, j), before it is kept within the piece.
  float ofCell(std::int64_t i, std::int64_t j) const {
    const Wide px = sampleAt(i - i % kCell), py = sampleAt(j - j % kCell);
    const float e20 = static_cast<float>(edge(piece_, 2, 0, px, py));
    const float e01 = static_cast<float>(edge(piece_, 0, 1, px, py));
    return piece_.z[0] + ((e20 * r_) * d1_ + (e01 * r_) * d2_);
  }
  float ofPixel(float zc, std::int64_t i, std::int64_t j) const {
    float z = (zc + zx_ * static_cast<float>(i % kCell)) + zy_ * static_cast<float>(j % kCell);
    z = (z > zmin_) ? z : zmin_;
    return (z < zmax_) ? z : zmax_;
  }

 private:
  const Piece& piece_;
  float r_, d1_, d2_, zx_ = 0, zy_ = 0, zmin_ = 0, zmax_ = 0;
};

// Exact depth of the snapped piece at a covered sample: the mean of its vertices' depths weighted by exact edge
// functions. All terms are >= 0, each product of 52 and 24 bits is exact in 113, so the result is right to about 2^-112
// of itself.
Exact exactDepth(const Piece& t, std::int64_t i, std::int64_t j) {
  const auto weight = [&](int a, int b) { return static_cast<Exact>(edge(t, a, b, sampleAt(i), sampleAt(j))); };
  const Exact w0 = weight(1, 2), w1 = weight(2, 0), w2 = weight(0, 1);
  return (w0 * t.z[0] + w1 * t.z[1] + w2 * t.z[2]) / (w0 + w1 + w2);
}

// Spacing of float32 numbers around z, z in [0, 1].
double unitInLastPlace(Exact z) {
  const auto rounded = static_cast<double>(z);
  const int exponent = rounded > 0 ? std::ilogb(rounded) : -126;
  return std::ldexp(1.0, std::max(exponent, -126) - 23);
}

void measure(Result& result, const std::vector<Piece>& all, const std::vector<std::uint32_t>& winner) {
  const Framebuffer& frame = result.image;
  for (std::size_t k = 0; k < frame.pixels(); ++k) {
    if (frame.ids[k] == kNoTriangle) continue;
    const auto i = static_cast<std::int64_t>(k % frame.width), j = static_cast<std::int64_t>(k / frame.width);
    const Exact exact = exactDepth(all[winner[k]], i, j);
    const double error = std::abs(static_cast<double>(static_cast<Exact>(frame.depth[k]) - exact));
    result.depthMaxAbs = std::max(result.depthMaxAbs, error);
    result.depthMaxUlp = std::max(result.depthMaxUlp, error / unitInLastPlace(exact));
  }
}

}  // namespace

Result render(const Scene& scene, const Image& image, bool measureDepth) {
  Result result;
  const std::vector<Piece> all = pieces(scene, image, &result.counts);
  Framebuffer& frame = result.image;
  frame.width = scene.width;
  frame.height = scene.height;
  frame.depth.assign(frame.pixels(), 1.0f);
  frame.ids.assign(frame.pixels(), kNoTriangle);
  frame.hits.assign(frame.pixels(), 0);
  std::vector<std::uint32_t> winner(measureDepth ? frame.pixels() : 0);  // index of the visible piece

  for (std::size_t index = 0; index < all.size(); ++index) {
    const Piece& piece = all[index];
    const DepthPlane plane(piece);
    const Range rows = coveredRows(piece, frame.height);
    for (std::int64_t j = rows.first; j <= rows.last; ++j) {
      const Range columns = coveredColumns(piece, j, frame.width);
      float zc = 0;
      for (std::int64_t i = columns.first; i <= columns.last; ++i) {
        if (i == columns.first || i % kCell == 0) zc = plane.ofCell(i, j);
        const float z = plane.ofPixel(zc, i, j);
        const std::size_t k = static_cast<std::size_t>(j) * frame.width + static_cast<std::size_t>(i);
        ++frame.hits[k];
        ++result.counts.covered;
        if (z < frame.depth[k] || (z == frame.depth[k] && piece.id < frame.ids[k])) {
          frame.depth[k] = z;
          frame.ids[k] = piece.id;
          if (measureDepth) winner[k] = static_cast<std::uint32_t>(index);
        }
      }
    }
  }
  if (measureDepth) measure(result, all, winner);
  return result;
}

}  // namespace tessera::reference
