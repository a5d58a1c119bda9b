// The oracle under the image axes: inclusive fill, sub-pixel bits, ways of interpolating depth.
#include <tessera/oracle.h>

#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "host/oracle/oracle-image.h"
#include "tests/reference/in-pixels.h"

using namespace tessera;
using namespace tessera::test;
using oracle::Fill, oracle::ImageAxes, oracle::Interpolate, oracle::Piece;

namespace {

constexpr double kUnit = 0x1p-24;  // largest relative error of one rounding

std::vector<std::string> picture(const std::vector<PixelVertex>& vertices, const std::vector<Triangle>& triangles,
                                 const oracle::ImageAxes& axes) {
  const Framebuffer frame = oracle::render(inPixels(8, 4, vertices, triangles), axes).image;
  std::vector<std::string> rows(frame.height, std::string(frame.width, '.'));
  for (std::size_t k = 0; k < frame.pixels(); ++k)
    if (frame.hits[k]) rows[k / frame.width][k % frame.width] = static_cast<char>('0' + frame.hits[k]);
  return rows;
}

// X of a vertex at `position` pixels of a raster of 4 x 4, whose Y is the same.
int snapped(float position, int bits) {
  const Scene scene = inPixels(4, 4, {{position, position}, {3.5f, 0.5f}, {0.5f, 3.5f}}, {{0, 1, 2}});
  const auto pieces = oracle::pieces(scene, {.subPixelBits = bits});
  REQUIRE(pieces.size() == 1);
  REQUIRE(pieces[0].x[0] == pieces[0].y[0]);
  return pieces[0].x[0];
}

std::int64_t edge(const oracle::Piece& t, int a, int b, std::int64_t px, std::int64_t py) {
  return std::int64_t{t.x[b] - t.x[a]} * (py - t.y[a]) - std::int64_t{t.y[b] - t.y[a]} * (px - t.x[a]);
}

struct Errors {
  double plane = 0, weights = 0, cellPlane = 0;  ///< largest, absolute
};

// Renders a triangle in each way and holds each pixel's depth against its bound, times 1.001 for what is of second
// order. With u = kUnit and D the largest difference of the piece's depths:
//   weights  float(E), r (area and quotient), their product, d, its product and the sum of two: 7 u on terms that add
//   up
//            to at most D; z0 + ... once more: 7 u D + u.
//   plane    float(difference), r, their product, d, its product, the sum of two: 7 u on each slope's terms; the factor
//   in
//            pixels, the product, and two more sums, which partial sums beyond [0, 1] pass through: 11 u on the sum of
//            the magnitudes of all terms, and u on z0 and on the result.
Errors checkBounds(const Scene& scene) {
  Errors errors;
  const auto pieces = oracle::pieces(scene, {});
  if (pieces.empty()) return errors;
  const oracle::Piece& t = pieces[0];
  const auto render = [&](oracle::Interpolate way) { return oracle::render(scene, {.interpolate = way}, true); };
  const auto weights = render(oracle::Interpolate::kWeights), plane = render(oracle::Interpolate::kPlane);
  errors = {plane.depthMaxAbs, weights.depthMaxAbs, render(oracle::Interpolate::kCellPlane).depthMaxAbs};
  const auto [zmin, zmax] = std::minmax({t.z[0], t.z[1], t.z[2]});
  CHECK(errors.weights <= (7 * kUnit * (double{zmax} - zmin) + kUnit) * 1.001);
  const double area = static_cast<double>(edge(t, 0, 1, t.x[2], t.y[2]));
  const double d1 = std::abs(double{t.z[1]} - t.z[0]), d2 = std::abs(double{t.z[2]} - t.z[0]);
  const double slopeX = (std::abs(t.y[2] - t.y[0]) * d1 + std::abs(t.y[0] - t.y[1]) * d2) / area;
  const double slopeY = (std::abs(t.x[0] - t.x[2]) * d1 + std::abs(t.x[1] - t.x[0]) * d2) / area;
  const Framebuffer& frame = plane.image;
  std::uint64_t beyond = 0;
  for (std::size_t k = 0; k < frame.pixels(); ++k) {
    if (!frame.hits[k]) continue;
    const auto px = static_cast<std::int64_t>(256 * (k % frame.width) + 128);
    const auto py = static_cast<std::int64_t>(256 * (k / frame.width) + 128);
    double exact = 0;
    for (int a = 0; a < 3; ++a) exact += static_cast<double>(edge(t, (a + 1) % 3, (a + 2) % 3, px, py)) / area * t.z[a];
    const double terms = slopeX * std::abs(double(px - t.x[0])) + slopeY * std::abs(double(py - t.y[0]));
    beyond += std::abs(frame.depth[k] - exact) > (11 * kUnit * terms + 2 * kUnit) * 1.001;
  }
  CHECK(beyond == 0);
  return errors;
}

}  // namespace

TEST_CASE("inclusive fill covers each sample of an edge from both sides and the whole outline") {
  const oracle::ImageAxes inclusive{.fill = oracle::Fill::kInclusive};
  const std::vector<PixelVertex> corners{{1.5f, 0.5f}, {4.5f, 0.5f}, {4.5f, 3.5f}, {1.5f, 3.5f}};
  CHECK(picture(corners, {{0, 1, 2}, {0, 2, 3}}, inclusive) ==
        std::vector<std::string>{".2111...", ".1211...", ".1121...", ".1112..."});
  CHECK(picture(corners, {{0, 1, 2}}, inclusive) ==
        std::vector<std::string>{".1111...", "..111...", "...11...", "....1..."});
  CHECK(picture(corners, {{0, 1, 2}, {0, 2, 3}}, {}) ==  // the top-left rule: each once, two edges of the outline not
        std::vector<std::string>{".111....", ".111....", ".111....", "........"});
  // Between samples there is nothing to include; a vertex on one sample has it.
  CHECK(picture({{2.625f, 0.625f}, {3.375f, 0.625f}, {2.625f, 1.375f}}, {{0, 1, 2}}, inclusive) ==
        std::vector<std::string>(4, "........"));
  CHECK(picture({{2.5f, 1.5f}, {1.75f, 1.5f}, {2.5f, 0.75f}}, {{0, 1, 2}}, inclusive)[1] == "..1.....");
}

TEST_CASE("inclusive fill is each edge function at least 0") {
  std::mt19937 random(23);
  constexpr std::uint32_t kSize = 32;
  std::uint64_t onEdges = 0;
  for (int round = 0; round < 5000; ++round) {
    std::vector<PixelVertex> v;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t step = round % 2 ? 2 : 256;  // half of them on centres and corners of pixels
      const auto x = random() % (kSize * step), y = random() % (kSize * step);
      v.push_back({static_cast<float>(x) / static_cast<float>(step), static_cast<float>(y) / static_cast<float>(step)});
    }
    const Scene scene = inPixels(kSize, kSize, v, {{0, 1, 2}});
    const oracle::ImageAxes image{.fill = oracle::Fill::kInclusive,
                                  .subPixelBits = std::array{0, 4, 6, 8}[round / 2 % 4]};
    const auto pieces = oracle::pieces(scene, image);
    if (pieces.empty()) continue;
    const auto result = oracle::render(scene, image);
    std::uint64_t wrong = 0;
    for (std::size_t k = 0; k < result.image.pixels(); ++k) {
      const auto px = static_cast<std::int64_t>(256 * (k % kSize) + 128);
      const auto py = static_cast<std::int64_t>(256 * (k / kSize) + 128);
      std::int64_t e[3];
      for (int a = 0; a < 3; ++a) e[a] = edge(pieces[0], a, (a + 1) % 3, px, py);
      const bool inside = std::ranges::all_of(e, [](std::int64_t value) { return value >= 0; });
      wrong += (result.image.hits[k] == 1) != inside;
      onEdges += inside && std::ranges::any_of(e, [](std::int64_t value) { return value == 0; });
    }
    REQUIRE(wrong == 0);
  }
  CHECK(onEdges > 10'000);
}

TEST_CASE("snapping goes to the nearest multiple and ties to even at each number of bits") {
  for (const int bits : {4, 6, 8}) {
    const float step = 1.0f / static_cast<float>(1 << bits);
    const int unit = 256 >> bits;
    CAPTURE(bits);
    const std::pair<float, int> cases[] = {{3.0f, 3},   {3.5f, 4},     {4.5f, 4},      {-0.5f, 0},
                                           {0.5f, 0},   {3.25f, 3},    {3.75f, 4},     {-1.5f, -2},
                                           {-2.5f, -2}, {4.53125f, 5}, {-3.53125f, -4}};
    for (const auto& [multiple, expected] : cases) {
      CAPTURE(multiple);
      CHECK(snapped(multiple * step, bits) == expected * unit);
    }
  }
}

TEST_CASE("without sub-pixel bits vertices lie on samples") {
  // Halfway between two samples, which is a whole pixel: to the even one.
  const std::pair<float, int> cases[] = {{0.5f, 0},   {1.5f, 1}, {1.0f, 0}, {2.0f, 2},    {0.0f, 0},    {3.0f, 2},
                                         {-1.0f, -2}, {1.2f, 1}, {1.8f, 1}, {-0.25f, -1}, {-0.75f, -1}, {3.75f, 3}};
  for (const auto& [position, pixel] : cases) {
    CAPTURE(position);
    CHECK(snapped(position, 0) == 256 * pixel + 128);
  }
}

TEST_CASE("without sub-pixel bits inclusive fill covers the pixels of the corners") {
  const oracle::ImageAxes image{.fill = oracle::Fill::kInclusive, .subPixelBits = 0};
  // (1, 0), (5, 0) and (1, 2) as integer vertices; anywhere within their pixels is the same.
  const std::vector<std::string> expected{".11111..", ".111....", ".1......", "........"};
  CHECK(picture({{1.5f, 0.5f}, {5.5f, 0.5f}, {1.5f, 2.5f}}, {{0, 1, 2}}, image) == expected);
  CHECK(picture({{1.1f, 0.9f}, {5.7f, 0.2f}, {1.9f, 2.6f}}, {{0, 1, 2}}, image) == expected);
  // The top-left rule leaves out the hypotenuse here, with its corners.
  CHECK(picture({{1.5f, 0.5f}, {5.5f, 0.5f}, {1.5f, 2.5f}}, {{0, 1, 2}}, {.subPixelBits = 0}) ==
        std::vector<std::string>{".1111...", ".11.....", "........", "........"});
}

TEST_CASE("plane and weights stay within their bounds and slivers are worst for the plane") {
  std::mt19937 random(29);
  const auto uniform = [&](double scale) { return static_cast<float>(random() * 0x1p-32 * scale); };
  Errors worst;
  const auto take = [&](const Errors& errors) {
    worst.plane = std::max(worst.plane, errors.plane);
    worst.weights = std::max(worst.weights, errors.weights);
    worst.cellPlane = std::max(worst.cellPlane, errors.cellPlane);
  };
  for (int round = 0; round < 300; ++round) {
    std::vector<PixelVertex> v;
    for (int k = 0; k < 3; ++k) v.push_back({uniform(128), uniform(128), uniform(1)});
    take(checkBounds(inPixels(128, 128, v, {{0, 1, 2}})));
  }
  CHECK(worst.weights > 0);
  const Errors fat = worst;
  worst = {};
  for (int round = 0; round < 300; ++round) {  // a pixel's breadth or less over the whole raster
    const float y = uniform(100);
    take(checkBounds(inPixels(
        128, 128, {{uniform(1), y, uniform(1)}, {128, y + 28, uniform(1)}, {64, y + 14 + uniform(0.5), uniform(1)}},
        {{0, 1, 2}})));
  }
  INFO("plane " << worst.plane << ", cell plane " << worst.cellPlane << ", weights " << worst.weights
                << "; not slivers " << fat.plane << ", " << fat.cellPlane << ", " << fat.weights);
  CHECK(worst.plane > 10 * worst.weights);
  CHECK(worst.plane > 10 * fat.plane);
  CHECK(worst.weights < 8 * kUnit);
}

TEST_CASE("interpolation has the stated bits in each way") {
  std::mt19937 random(31);
  const auto uniform = [&](double scale) { return static_cast<float>(random() * 0x1p-32 * scale); };
  std::uint64_t compared = 0, apart = 0;
  for (int round = 0; round < 300; ++round) {
    std::vector<PixelVertex> v;
    for (int k = 0; k < 3; ++k) v.push_back({uniform(64), uniform(64), uniform(1)});
    const Scene scene = inPixels(64, 64, v, {{0, 1, 2}});
    const auto pieces = oracle::pieces(scene, {});
    if (pieces.empty()) continue;
    const oracle::Piece& t = pieces[0];
    const auto weights = oracle::render(scene, {.interpolate = oracle::Interpolate::kWeights}).image;
    const auto plane = oracle::render(scene, {.interpolate = oracle::Interpolate::kPlane}).image;
    const auto [zmin, zmax] = std::minmax({t.z[0], t.z[1], t.z[2]});
    const auto f = [](std::int64_t n) { return static_cast<float>(n); };
    const float r = 1.0f / f(edge(t, 0, 1, t.x[2], t.y[2])), d1 = t.z[1] - t.z[0], d2 = t.z[2] - t.z[0];
    const float zx = ((f(t.y[2] - t.y[0]) * 256) * r) * d1 + ((f(t.y[0] - t.y[1]) * 256) * r) * d2;
    const float zy = ((f(t.x[0] - t.x[2]) * 256) * r) * d1 + ((f(t.x[1] - t.x[0]) * 256) * r) * d2;
    std::uint64_t wrong = 0;
    for (std::size_t k = 0; k < plane.pixels(); ++k) {
      if (!plane.hits[k]) continue;
      const auto px = static_cast<std::int64_t>(256 * (k % 64) + 128),
                 py = static_cast<std::int64_t>(256 * (k / 64) + 128);
      const float byWeights = t.z[0] + ((f(edge(t, 2, 0, px, py)) * r) * d1 + (f(edge(t, 0, 1, px, py)) * r) * d2);
      const float byPlane = (t.z[0] + zx * (f(px - t.x[0]) / 256)) + zy * (f(py - t.y[0]) / 256);
      const auto same = [](float a, float b) {
        return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
      };
      wrong += !same(weights.depth[k], std::clamp(byWeights, zmin, zmax));
      wrong += !same(plane.depth[k], std::clamp(byPlane, zmin, zmax));
      apart += !same(plane.depth[k], weights.depth[k]);
      ++compared;
    }
    REQUIRE(wrong == 0);
  }
  CHECK(compared > 10'000);
  CHECK(apart > 1'000);
}

TEST_CASE("a variant's image axes are the oracle's") {
  CHECK(oracle::imageAxesOf({}).cull == oracle::Cull::kNone);
  CHECK(oracle::imageAxesOf({}).fill == oracle::Fill::kTopLeft);
  CHECK(oracle::imageAxesOf({}).interpolate == oracle::Interpolate::kCellPlane);
  CHECK(oracle::imageAxesOf({}).subPixelBits == 8);
  CHECK(oracle::imageAxesOf({{"cull", "back"}}).cull == oracle::Cull::kBack);
  CHECK(oracle::imageAxesOf({{"cull", "front"}}).cull == oracle::Cull::kFront);
}
