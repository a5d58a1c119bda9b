// The oracle's clipping: each plane by hand, shared edges, rasters and triangles as large as they get.
#include <tessera/oracle.h>

#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <random>

#include "host/oracle/reference-clip.h"
#include "tests/reference/in-pixels.h"

using namespace tessera;
using namespace tessera::test;
using glm::vec4;

namespace {

using Polygon = std::vector<vec4>;

bool allHitOnce(const Framebuffer& frame) {
  return std::all_of(frame.hits.begin(), frame.hits.end(), [](std::uint32_t hits) { return hits == 1; });
}

bool sameBits(const vec4& a, const vec4& b) {
  return std::bit_cast<std::array<std::uint32_t, 4>>(a) == std::bit_cast<std::array<std::uint32_t, 4>>(b);
}

}  // namespace

TEST_CASE("near and far planes give the points and the first corner of Sutherland-Hodgman") {
  const vec4 a(-1, -1, 0.5f, 1), b(1, -1, 0.5f, 1), c(-1, 1, 0.5f, 1);
  const vec4 beforeEye(-1, -1, -0.5f, 1), beyond(-1, -1, 1.5f, 1);
  // t = 1/2 on both edges.
  const Polygon cutNear{{0, -1, 0, 1}, b, c, {-1, 0, 0, 1}};
  CHECK(oracle::clip({beforeEye, b, c}, 256, 256).polygon == cutNear);
  const Polygon cutFar{{0, -1, 1, 1}, b, c, {-1, 0, 1, 1}};
  CHECK(oracle::clip({beyond, b, c}, 256, 256).polygon == cutFar);
  // The same triangle turned: another first vertex, the same points.
  CHECK(oracle::clip({b, c, beforeEye}, 256, 256).polygon == Polygon{b, c, {-1, 0, 0, 1}, {0, -1, 0, 1}});
  CHECK(oracle::clip({beforeEye, b, c}, 256, 256).outsideSome);
  // Two vertices outside leave a triangle.
  const Polygon corner{a, {0, -1, 0, 1}, {-1, 0, 0, 1}};
  CHECK(oracle::clip({a, {1, -1, -0.5f, 1}, {-1, 1, -0.5f, 1}}, 256, 256).polygon == corner);
  // Touching a plane is inside; beyond it in every vertex is nothing.
  const auto touching = oracle::clip({vec4(-1, -1, 0, 1), vec4(1, -1, 1, 1), vec4(-1, 1, -0.0f, 1)}, 256, 256);
  CHECK(touching.polygon.size() == 3);
  CHECK_FALSE(touching.outsideSome);
  const auto outside = oracle::clip({beyond, beyond, beyond}, 256, 256);
  CHECK(outside.polygon.empty());
  CHECK(outside.outsideSome);
}

TEST_CASE("the guard band lies 32767 pixels either side of the centre on each of four sides") {
  // 2 x 2: |x| <= 32767 w. One vertex at twice that: t = 1/2.
  constexpr float kGuard = 32767;
  for (const int axis : {0, 1}) {
    for (const float sign : {-1.0f, 1.0f}) {
      CAPTURE(axis, sign);
      const int other = 1 - axis;
      vec4 out(0, 0, 0.5f, 1), low(0, 0, 0.25f, 1), high(0, 0, 0.75f, 1);
      out[axis] = sign * 2 * kGuard;
      low[other] = -8;
      high[other] = 8;
      vec4 cutLow(0, 0, 0.375f, 1), cutHigh(0, 0, 0.625f, 1);
      cutLow[axis] = cutHigh[axis] = sign * kGuard;
      cutLow[other] = -4;
      cutHigh[other] = 4;
      const auto clipped = oracle::clip({out, low, high}, 2, 2);
      CHECK(clipped.outsideSome);
      CHECK(clipped.polygon == Polygon{cutLow, low, high, cutHigh});

      out[axis] = sign * kGuard;  // on it: untouched, and as far out as a snapped position gets on this raster
      CHECK_FALSE(oracle::clip({out, low, high}, 2, 2).outsideSome);
      Scene scene;
      scene.width = scene.height = 2;
      scene.clip = {out, low, high};
      scene.triangles = {{0, 1, 2}};
      const auto pieces = oracle::pieces(scene, {});
      REQUIRE(pieces.size() == 1);
      const std::int32_t reached = axis == 0 ? pieces[0].x[0] : pieces[0].y[0];
      CHECK(reached == (sign > 0 ? 32768 * 256 : -32766 * 256));
    }
  }
}

TEST_CASE("a triangle inside the guard band is not clipped however far it lies outside the raster") {
  oracle::Counts counts;
  const auto scene = inPixels(16, 16, {{-1000, -1000}, {3000, 8}, {-1000, 2000}}, {{0, 1, 2}});
  CHECK(oracle::pieces(scene, {}, &counts).size() == 1);
  CHECK(counts.clipped == 0);
  CHECK(counts.outside == 0);
}

TEST_CASE("a clipped triangle keeps its id in every piece and counts once") {
  Scene scene;
  scene.width = scene.height = 64;
  scene.clip = {{0, 0, 0, 1},       {0.01f, 0, 0, 1}, {0, 0.01f, 0, 1},
                {-1, -1, -0.5f, 1}, {1, -1, 0.5f, 1}, {-1, 1, 1.5f, 1}};
  scene.triangles = {{0, 1, 2}, {3, 4, 5}};
  oracle::Counts counts;
  const auto pieces = oracle::pieces(scene, {}, &counts);
  CHECK(counts.clipped == 1);
  REQUIRE(pieces.size() > 2);
  CHECK(pieces[0].id == 0);
  for (std::size_t k = 1; k < pieces.size(); ++k) CHECK(pieces[k].id == 1);
}

TEST_CASE("two triangles that share an edge get the same clip point whichever way each runs along it") {
  std::mt19937 random(5);
  const auto uniform = [&] { return static_cast<float>(random() * 0x1p-31 - 1); };
  int cut = 0;
  for (int round = 0; round < 20'000; ++round) {
    const vec4 a(uniform() * 0.5f, uniform() * 0.5f, 0.25f + 0.2f * uniform(),
                 1 + 0.5f * uniform());  // inside all planes
    const auto anywhere = [&] { return vec4(1e5f * uniform(), 1e5f * uniform(), 3 * uniform(), 2 * uniform()); };
    const vec4 b = anywhere(), c = anywhere(), d = anywhere();
    const auto one = oracle::clip({a, b, c}, 64, 64).polygon, two = oracle::clip({b, a, d}, 64, 64).polygon;
    // The shared edge ends at `a` and at the last point that clipping left on it: after `a` in one, before it in the
    // other.
    const auto at = [&](const Polygon& p) {
      return std::find_if(p.begin(), p.end(), [&](const vec4& v) { return sameBits(v, a); }) - p.begin();
    };
    const auto i = static_cast<std::size_t>(at(one)), k = static_cast<std::size_t>(at(two));
    REQUIRE(i < one.size());
    REQUIRE(k < two.size());
    const vec4 endOne = one[(i + 1) % one.size()], endTwo = two[(k + two.size() - 1) % two.size()];
    REQUIRE(sameBits(endOne, endTwo));
    cut += !sameBits(endOne, b);
  }
  CHECK(cut > 15'000);
}

TEST_CASE("rounding can leave more corners than planes would in real numbers") {
  // Found by search: with the last plane crossing a bent polygon four times, 10 corners. Fixed arrays of 9 would
  // overflow.
  const auto clipped = oracle::clip({vec4(0.5f, -0x1.16c2p-133f, 0x1.b38fb8p-127f, -1),
                                     vec4(0x1.16c2p-133f, -0x1.ff933cp+127f, -0x1.16c2p-133f, 0x1.ff933cp+127f),
                                     vec4(0x1.93e594p+99f, 0x1.ff933cp+127f, 0x1.16c2p-133f, 0x1.93e594p+99f)},
                                    333, 32768);
  CHECK(clipped.polygon.size() == 10);
}

TEST_CASE("a quad from behind the eye to the horizon is hit once also where it is clipped") {
  // A floor below the eye: y = 1 (down), from 8 behind to 64 ahead; w is the distance ahead, and z reaches 0 at 0.5
  // ahead.
  Scene scene;
  scene.width = scene.height = 256;
  const auto corner = [](float x, float ahead) { return vec4(x, 1, (ahead - 0.5f) * 0.75f, ahead); };
  scene.clip = {corner(-1000, -8), corner(1000, -8), corner(1000, 64), corner(-1000, 64)};
  for (const auto& triangles :
       {std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}, std::vector<Triangle>{{1, 2, 3}, {1, 3, 0}}}) {
    scene.triangles = triangles;
    const auto result = oracle::render(scene);
    CHECK(result.counts.clipped == 2);
    // The floor at `ahead` is seen on row 128 + 128 / ahead: from the horizon's 130 down to the last row, at ahead > 1.
    std::uint64_t wrong = 0;
    for (std::size_t k = 0; k < result.image.pixels(); ++k) {
      const std::size_t row = k / 256;
      wrong += result.image.hits[k] != (row >= 130 ? 1u : 0u);
    }
    CHECK(wrong == 0);
  }
}

TEST_CASE("a quad far past every side of the guard band covers the raster once") {
  Scene scene;
  scene.width = 301;
  scene.height = 77;
  for (const float far : {1e6f, 1e12f, 1e30f}) {
    scene.clip = {{-far, -far, 0.5f, 1}, {far, -far, 0.5f, 1}, {far, far, 0.5f, 1}, {-far, far, 0.5f, 1}};
    for (const auto& triangles :
         {std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}, std::vector<Triangle>{{0, 1, 3}, {1, 2, 3}}}) {
      scene.triangles = triangles;
      CAPTURE(far);
      CHECK(allHitOnce(oracle::render(scene).image));
    }
  }
}

TEST_CASE("rasters of 1 pixel and 32768 wide or tall are covered to their last pixel") {
  for (const auto& [width, height] : {std::pair{1u, 1u}, {32768u, 3u}, {3u, 32768u}, {32767u, 1u}}) {
    Scene scene;
    scene.width = width;
    scene.height = height;
    scene.clip = {{-1, -1, 0, 1}, {1, -1, 0.5f, 1}, {1, 1, 1, 1}, {-1, 1, 0.5f, 1}};
    scene.triangles = {{0, 1, 2}, {0, 2, 3}};
    CAPTURE(width, height);
    const auto result = oracle::render(scene, {}, true);
    CHECK(allHitOnce(result.image));
    CHECK(result.counts.covered == std::uint64_t{width} * height);
    CHECK(result.depthMaxAbs < 1e-5);
    // Beyond the guard band's reach on this raster, still one hit a sample.
    for (vec4& v : scene.clip) v.x *= 50, v.y *= 70'000;
    CHECK(allHitOnce(oracle::render(scene).image));
  }
}
