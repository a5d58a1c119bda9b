// The oracle, section by section of the contract in rasterizer.h: projection, snapping, orientation, order, depth.
#include <tessera/oracle.h>

#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "tests/reference/in-pixels.h"

using namespace tessera;
using namespace tessera::test;
using oracle::Cull;

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

// One pixel that everything covers: a triangle over all of a 1 x 1 raster, at one depth.
std::vector<PixelVertex> over(float z) { return {{-4, -4, z}, {8, -4, z}, {-4, 8, z}}; }

std::vector<PixelVertex> operator+(std::vector<PixelVertex> a, const std::vector<PixelVertex>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

oracle::Result renderOver(const std::vector<PixelVertex>& vertices) {
  return oracle::render(inPixels(1, 1, vertices, inThrees(vertices.size())));
}

}  // namespace

TEST_CASE("the transform is four sums in the stated order") {
  Scene scene;
  scene.positions = {{0.1f, 0.2f, 0.3f}};
  for (int k = 0; k < 16; ++k) scene.clipFromObject[k] = 1.0f / static_cast<float>(k + 3);
  const glm::vec4 v = oracle::transform(scene)[0];
  for (int r = 0; r < 4; ++r) {
    const float* m = &scene.clipFromObject[4 * r];
    const volatile float a = m[0] * 0.1f, b = m[1] * 0.2f, c = m[2] * 0.3f;  // volatile: each product rounded by itself
    const volatile float ab = a + b, abc = ab + c;
    CHECK(v[r] == abc + m[3]);
  }
  scene.positions.clear();
  scene.clip = {{1, 2, 3, 4}};
  CHECK(oracle::transform(scene)[0] == glm::vec4(1, 2, 3, 4));  // clip positions are taken as they are
}

TEST_CASE("positions snap to the nearest 1/256 pixel and ties to even") {
  // On a raster of 2 x 2 the centre is at X = 256: s = 256 x + 256 is exact.
  const std::pair<float, int> cases[] = {{10.5f, 10}, {11.5f, 12}, {0.5f, 0},  {1.5f, 2},    {-0.5f, 0},   {-1.5f, -2},
                                         {-2.5f, -2}, {7.25f, 7},  {7.75f, 8}, {-7.25f, -7}, {-7.75f, -8}, {3.0f, 3}};
  for (const auto& [s, expected] : cases) {
    Scene scene;
    scene.width = scene.height = 2;
    const float c = (s - 256) / 256;
    scene.clip = {{c, c, 0, 1}, {1, -1, 0, 1}, {1, 1, 0, 1}};
    scene.triangles = {{0, 1, 2}};
    const auto pieces = oracle::pieces(scene, {});
    REQUIRE(pieces.size() == 1);
    CAPTURE(s);
    CHECK(pieces[0].x[0] == expected);
    CHECK(pieces[0].y[0] == expected);
  }
}

TEST_CASE("projection multiplies by the rounded reciprocal") {
  Scene scene;
  scene.width = scene.height = 32768;
  scene.triangles = {{0, 1, 2}};
  const auto snapped = [](float n) {
    const volatile float m = n * 16384.0f, s = (m + 16384.0f) * 256.0f;
    return static_cast<std::int32_t>(std::nearbyint(s));
  };
  std::mt19937 random(3);
  int apart = 0;
  for (int round = 0; round < 2000; ++round) {
    const float w = 3 + static_cast<float>(random() * 0x1p-32),
                x = -w * (0.9f + static_cast<float>(random() * 0x1p-36));
    scene.clip = {{x, 0, 0.25f * w, w}, {1, -1, 0, 1}, {1, 1, 0, 1}};
    const volatile float r = 1.0f / w, product = x * r, quotient = x / w;
    REQUIRE(oracle::pieces(scene, {})[0].x[0] == snapped(product));
    apart += snapped(product) != snapped(quotient);
  }
  CHECK(apart > 0);  // so dividing would have been seen
}

TEST_CASE("negative area is front and is reordered to positive") {
  const std::vector<PixelVertex> vertices{{0, 0, 0.1f}, {0, 4, 0.2f}, {4, 0, 0.3f}};  // down, then up to the right
  const Scene front = inPixels(8, 8, vertices, {{0, 1, 2}});
  const Scene back = inPixels(8, 8, vertices, {{0, 2, 1}});
  for (const Scene& scene : {front, back}) {
    const auto pieces = oracle::pieces(scene, {});
    REQUIRE(pieces.size() == 1);
    const oracle::Piece& t = pieces[0];
    CHECK(std::vector(t.x, t.x + 3) == std::vector{0, 1024, 0});
    CHECK(std::vector(t.y, t.y + 3) == std::vector{0, 0, 1024});
    CHECK(std::vector(t.z, t.z + 3) == std::vector{0.1f, 0.3f, 0.2f});
  }
  oracle::Counts counts;
  CHECK(oracle::pieces(front, {Cull::kBack}, &counts).size() == 1);
  CHECK(counts.facing == 0);
  CHECK(oracle::pieces(front, {Cull::kFront}, &counts).empty());
  CHECK(counts.facing == 1);
  CHECK(oracle::pieces(back, {Cull::kBack}, &counts).empty());
  CHECK(counts.facing == 1);
  CHECK(oracle::pieces(back, {Cull::kFront}, &counts).size() == 1);
}

TEST_CASE("zero area is dropped after snapping and counted") {
  const auto counts = [](std::vector<PixelVertex> v) {
    oracle::Counts c;
    CHECK(oracle::pieces(inPixels(8, 8, v, {{0, 1, 2}}), {}, &c).empty());
    return c;
  };
  CHECK(counts({{1, 1}, {2, 2}, {3, 3}}).zeroArea == 1);
  CHECK(counts({{1, 1}, {1, 1}, {3, 3}}).zeroArea == 1);
  CHECK(counts({{1, 1}, {1.001f, 1}, {1, 1.001f}}).zeroArea == 1);  // not degenerate until it is snapped
}

TEST_CASE("nearer wins and at equal depth the lower id and 1.0 is drawn") {
  CHECK(renderOver(over(0.5f) + over(0.25f)).image.ids[0] == 1);
  CHECK(renderOver(over(0.25f) + over(0.5f)).image.ids[0] == 0);
  CHECK(renderOver(over(0.5f) + over(0.5f) + over(0.5f)).image.ids[0] == 0);
  const auto far = renderOver(over(1.0f));
  CHECK(far.image.ids[0] == 0);
  CHECK(far.image.depth[0] == 1.0f);
  CHECK(far.image.hits[0] == 1);
  const auto none = renderOver({});
  CHECK(none.image.ids == std::vector{kNoTriangle});
  CHECK(none.image.depth == std::vector{1.0f});
  CHECK(none.image.hits == std::vector{0u});
}

TEST_CASE("a depth of -0 is written as +0") {
  const auto result = renderOver(over(-0.0f));
  CHECK(result.image.ids[0] == 0);
  CHECK(std::bit_cast<std::uint32_t>(result.image.depth[0]) == 0);
}

TEST_CASE("depth is linear on the screen and exact where the plane is") {
  // 8 x 8 pixels: 1/area2 is a power of two, and z rises by 1/8 a pixel.
  const Scene scene = inPixels(16, 16, {{0, 0, 0}, {8, 0, 1}, {0, 8, 0}}, {{0, 1, 2}});
  const auto result = oracle::render(scene, {}, true);
  for (std::uint32_t i = 0; i < 7; ++i) CHECK(result.image.depth[i] == (static_cast<float>(i) + 0.5f) / 8);
  CHECK(result.depthMaxAbs == 0);
  CHECK(result.depthMaxUlp == 0);
}

TEST_CASE("depth has the bits of the contract and stays within its piece") {
  std::mt19937 random(11);
  const auto uniform = [&](double scale) { return static_cast<float>(random() * 0x1p-32 * scale); };
  constexpr std::uint32_t kSize = 64;
  std::uint64_t compared = 0, clamped = 0;
  for (int round = 0; round < 2000; ++round) {
    std::vector<PixelVertex> v;
    for (int k = 0; k < 3; ++k) v.push_back({uniform(kSize), uniform(kSize), uniform(1)});
    if (round % 2) {  // one edge at one depth through samples: on it rounding leaves the piece's range now and then
      for (PixelVertex& p : v) p.x = std::floor(p.x) + 0.5f, p.y = std::floor(p.y) + 0.5f;
      v[2].z = v[1].z;
    }
    const Scene scene = inPixels(kSize, kSize, v, {{0, 1, 2}});
    const auto all = oracle::pieces(scene, {});
    if (all.empty()) continue;
    const oracle::Piece& t = all[0];
    const auto result = oracle::render(scene);
    const auto [zmin, zmax] = std::minmax({t.z[0], t.z[1], t.z[2]});
    const auto e = [&](int a, int b, std::int64_t px, std::int64_t py) {
      return static_cast<float>(std::int64_t{t.x[b] - t.x[a]} * (py - t.y[a]) -
                                std::int64_t{t.y[b] - t.y[a]} * (px - t.x[a]));
    };
    const float r = 1.0f / e(0, 1, t.x[2], t.y[2]), d1 = t.z[1] - t.z[0], d2 = t.z[2] - t.z[0];
    const auto f = [](int n) { return static_cast<float>(n); };
    const float zx = ((f(t.y[2] - t.y[0]) * 256) * r) * d1 + ((f(t.y[0] - t.y[1]) * 256) * r) * d2;
    const float zy = ((f(t.x[0] - t.x[2]) * 256) * r) * d1 + ((f(t.x[1] - t.x[0]) * 256) * r) * d2;
    std::uint64_t wrong = 0;
    for (int j = 0; j < static_cast<int>(kSize); ++j) {
      for (int i = 0; i < static_cast<int>(kSize); ++i) {
        const std::size_t k = static_cast<std::size_t>(j) * kSize + static_cast<std::size_t>(i);
        if (!result.image.hits[k]) continue;
        const int px = 256 * (i - i % 8) + 128, py = 256 * (j - j % 8) + 128;
        const float zc = t.z[0] + ((e(2, 0, px, py) * r) * d1 + (e(0, 1, px, py) * r) * d2);
        float z = (zc + zx * f(i % 8)) + zy * f(j % 8);
        clamped += z < zmin || z > zmax;
        z = std::clamp(z, zmin, zmax);
        wrong += std::bit_cast<std::uint32_t>(z) != std::bit_cast<std::uint32_t>(result.image.depth[k]);
        ++compared;
      }
    }
    REQUIRE(wrong == 0);
  }
  CHECK(compared > 100'000);
  CHECK(clamped > 0);
}

TEST_CASE("the reported depth error is that against the exact rational depth") {
  std::mt19937 random(13);
  constexpr std::uint32_t kSize = 64;
  for (int round = 0; round < 50; ++round) {
    std::vector<PixelVertex> v;
    for (int k = 0; k < 3; ++k) {
      v.push_back({static_cast<float>(random() % (kSize * 256)) / 256,
                   static_cast<float>(random() % (kSize * 256)) / 256, static_cast<float>(random() % 4097) / 4096});
    }
    const Scene scene = inPixels(kSize, kSize, v, {{0, 1, 2}});
    const auto all = oracle::pieces(scene, {});
    if (all.empty()) continue;
    const oracle::Piece& t = all[0];
    const auto result = oracle::render(scene, {}, true);
    double maxAbs = 0, maxUlp = 0;
    for (std::size_t k = 0; k < result.image.pixels(); ++k) {
      if (!result.image.hits[k]) continue;
      const auto px = static_cast<std::int64_t>(256 * (k % kSize) + 128);
      const auto py = static_cast<std::int64_t>(256 * (k / kSize) + 128);
      std::int64_t numerator = 0, area2 = 0;  // exact depth = numerator / (4096 area2); below 2^60
      for (int a = 0; a < 3; ++a) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        const std::int64_t e =
            std::int64_t{t.x[c] - t.x[b]} * (py - t.y[b]) - std::int64_t{t.y[c] - t.y[b]} * (px - t.x[b]);
        numerator += e * static_cast<std::int64_t>(t.z[a] * 4096);
        area2 += e;
      }
      // depth = m 2^-40 up to what is below 2^-40, added in double: |m| < 2^41, area2 < 2^29.
      const double scaled = static_cast<double>(result.image.depth[k]) * 0x1p40;
      const auto m = static_cast<std::int64_t>(scaled);
      const __int128 difference = static_cast<__int128>(m) * area2 - (static_cast<__int128>(numerator) << 28);
      const double rest = scaled - static_cast<double>(m);
      const double error = std::abs((static_cast<double>(difference) / static_cast<double>(area2) + rest) * 0x1p-40);
      const double exact = static_cast<double>(numerator) / (4096.0 * static_cast<double>(area2));
      maxAbs = std::max(maxAbs, error);
      maxUlp = std::max(maxUlp, error / std::ldexp(1.0, std::ilogb(exact) - 23));
    }
    CHECK(result.depthMaxAbs == Approx(maxAbs).epsilon(1e-9));
    CHECK(result.depthMaxUlp == Approx(maxUlp).epsilon(1e-9));
  }
}

TEST_CASE("unusable triangles are dropped with their cause and the rest of the image is intact") {
  const auto good = over(0.5f);
  const Scene clean = inPixels(1, 1, good, {{0, 1, 2}});
  Scene scene = clean;
  scene.clip.own().insert(scene.clip.own().end(), {{kNaN, 0, 0, 1},
                                                   {0, kInfinity, 0, 1},
                                                   {0, 0, -kInfinity, 1},
                                                   {0, 0, 0, kNaN},  // 3 to 6
                                                   {0, 0, 0.5f, 0},
                                                   {0, 0, 0, 0},
                                                   {0, 0, 0, 1e-40f},  // 7 to 9
                                                   {1, 0, 0.5f, -1},
                                                   {0, 1, 0.5f, -2},
                                                   {1, 1, 0.5f, -1}});         // 10 to 12
  scene.triangles = {{0, 1, 99},   {0xffffffffu, 1, 2},                        // out of range
                     {0, 3, 1},    {4, 0, 1},           {0, 1, 5}, {6, 1, 0},  // not finite
                     {10, 11, 12},                                             // behind the eye in every vertex
                     {0, 1, 8},    {0, 1, 9},                                  // w = 0; 1/w = infinity
                     {1, 1, 2},                                                // repeated vertex
                     {0, 1, 2}};
  const auto result = oracle::render(scene);
  CHECK(result.counts.submitted == 11);
  CHECK(result.counts.badIndex == 2);
  CHECK(result.counts.nonFinite == 4);
  CHECK(result.counts.outside == 1);
  CHECK(result.counts.behind == 2);
  CHECK(result.counts.zeroArea == 1);
  CHECK(result.counts.covered == 1);
  CHECK(result.image.ids[0] == 10);
  CHECK(result.image.depth == oracle::render(clean).image.depth);

  Scene empty;
  empty.width = empty.height = 3;
  CHECK(oracle::render(empty).counts.submitted == 0);
  empty.triangles = {{0, 1, 2}};  // indices without vertices
  CHECK(oracle::render(empty).counts.badIndex == 1);
}

TEST_CASE("whatever float32 patterns come in pieces stay in range") {
  std::mt19937 random(17);
  const float special[] = {0.0f,   -0.0f,   1.0f,     -1.0f, 0.5f,     1e-40f,  -1e-40f,
                           1e-38f, 3.4e38f, -3.4e38f, 1e30f, 32767.0f, 65534.0f};
  const auto any = [&] {
    if (random() % 3 == 0) return special[random() % std::size(special)];
    if (random() % 2 == 0) return static_cast<float>(static_cast<std::int32_t>(random())) * 0x1p-30f;
    return std::bit_cast<float>(static_cast<std::uint32_t>(random()));
  };
  const std::uint32_t sizes[] = {1, 2, 333, 32768};
  Scene scene;
  scene.triangles = {{0, 1, 2}};
  std::uint64_t kept = 0, behind = 0, wrong = 0;
  for (int round = 0; round < 300'000; ++round) {
    scene.width = sizes[random() % 4];
    scene.height = sizes[random() % 4];
    scene.clip.clear();
    for (int k = 0; k < 3; ++k) {
      const float x = any(), y = any(), z = any(), w = any();
      scene.clip.emplace_back(x, y, z, w);
    }
    oracle::Counts counts;
    for (const oracle::Piece& t : oracle::pieces(scene, {}, &counts)) {
      ++kept;
      for (int k = 0; k < 3; ++k) {
        wrong += std::abs(t.x[k]) > 1 << 24 || std::abs(t.y[k]) > 1 << 24;
        wrong += !(t.z[k] >= 0 && t.z[k] <= 1) || std::signbit(t.z[k]);
      }
    }
    behind += counts.behind;
  }
  CHECK(wrong == 0);
  CHECK(kept > 10'000);
  CHECK(behind > 1'000);
}
