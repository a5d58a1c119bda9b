// The contract's sections Cover and Visible.
#include <tessera/oracle.h>

#include <algorithm>
#include <cmath>

#include "host/oracle/reference-depth.h"
#include "host/oracle/reference-exact.h"

namespace tessera::oracle {
namespace {

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
Range columnsInside(const Piece& t, int a, int b, Fill fill, std::int64_t row, Range within) {
  const Wide base = edge(t, a, b, sampleAt(0), sampleAt(row));
  const Wide slope = Wide{t.y[a] - t.y[b]} * 256;
  const Wide least = fill == Fill::kInclusive || isTopOrLeft(t, a, b) ? 0 : 1;
  if (slope > 0)
    within.first = static_cast<std::int64_t>(std::max<Wide>(within.first, ceilDivide(least - base, slope)));
  if (slope < 0)
    within.last = static_cast<std::int64_t>(std::min<Wide>(within.last, floorDivide(base - least, -slope)));
  if (slope == 0 && base < least) within.last = within.first - 1;
  return within;
}

Range coveredColumns(const Piece& t, Fill fill, std::int64_t row, std::uint32_t width) {
  Range range{0, std::int64_t{width} - 1};
  for (int a = 0; a < 3 && range.first <= range.last; ++a) range = columnsInside(t, a, (a + 1) % 3, fill, row, range);
  return range;
}

Range coveredRows(const Piece& t, std::uint32_t height) {
  const auto [least, most] = std::minmax({t.y[0], t.y[1], t.y[2]});
  return {static_cast<std::int64_t>(std::max<Wide>(0, ceilDivide(least - 128, 256))),
          static_cast<std::int64_t>(std::min<Wide>(Wide{height} - 1, floorDivide(most - 128, 256)))};
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

Result render(const Scene& scene, const ImageAxes& axes, bool measureDepth) {
  Result result;
  const std::vector<Piece> all = pieces(scene, axes, &result.counts);
  Framebuffer& frame = result.image;
  frame.width = scene.width;
  frame.height = scene.height;
  frame.depth.assign(frame.pixels(), 1.0f);
  frame.ids.assign(frame.pixels(), kNoTriangle);
  frame.hits.assign(frame.pixels(), 0);
  std::vector<std::uint32_t> winner(measureDepth ? frame.pixels() : 0);  // index of the visible piece

  for (std::size_t index = 0; index < all.size(); ++index) {
    const Piece& piece = all[index];
    Depth depth(piece, axes.interpolate);
    const Range rows = coveredRows(piece, frame.height);
    for (std::int64_t j = rows.first; j <= rows.last; ++j) {
      const Range columns = coveredColumns(piece, axes.fill, j, frame.width);
      for (std::int64_t i = columns.first; i <= columns.last; ++i) {
        const float z = depth.at(i, j);
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
  if (scene.attribute() != nullptr) interpolate(scene, axes, frame);
  return result;
}

}  // namespace tessera::oracle
