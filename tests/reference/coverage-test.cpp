// The oracle's coverage: the top-left rule by hand, closed surfaces hit once, intervals against pixel-by-pixel tests.
#include <tessera/oracle.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "tests/reference/in-pixels.h"

using namespace tessera;
using namespace tessera::test;

namespace {

// Rows of a small raster, '.' for no hit, digits for hits.
std::vector<std::string> picture(const Framebuffer& frame) {
  std::vector<std::string> rows(frame.height, std::string(frame.width, '.'));
  for (std::size_t k = 0; k < frame.pixels(); ++k) {
    if (frame.hits[k]) rows[k / frame.width][k % frame.width] = static_cast<char>('0' + frame.hits[k]);
  }
  return rows;
}

std::vector<std::string> picture(std::vector<PixelVertex> vertices, std::vector<Triangle> triangles) {
  return picture(oracle::render(inPixels(8, 4, vertices, std::move(triangles))).image);
}

bool allHitOnce(const Framebuffer& frame) {
  return std::all_of(frame.hits.begin(), frame.hits.end(), [](std::uint32_t hits) { return hits == 1; });
}

}  // namespace

TEST_CASE("a diagonal through pixel centres belongs to the triangle on its right") {
  const std::vector<PixelVertex> corners{{0, 0}, {4, 0}, {4, 4}, {0, 4}};
  CHECK(picture(corners, {{0, 1, 3}}) == std::vector<std::string>{"111.....", "11......", "1.......", "........"});
  CHECK(picture(corners, {{1, 2, 3}}) == std::vector<std::string>{"...1....", "..11....", ".111....", "1111...."});
  CHECK(picture(corners, {{0, 1, 2}}) == std::vector<std::string>{"1111....", ".111....", "..11....", "...1...."});
  CHECK(picture(corners, {{0, 2, 3}}) == std::vector<std::string>{"........", "1.......", "11......", "111....."});
}

TEST_CASE("a quad with its corners on pixel centres has its top and left samples only") {
  const std::vector<PixelVertex> corners{{1.5f, 0.5f}, {5.5f, 0.5f}, {5.5f, 2.5f}, {1.5f, 2.5f}};
  const std::vector<std::string> expected{".1111...", ".1111...", "........", "........"};
  for (std::array<std::uint32_t, 4> q : {std::array{0u, 1u, 2u, 3u}, std::array{1u, 2u, 3u, 0u}}) {
    for (const bool flipFirst : {false, true}) {
      for (const bool flipSecond : {false, true}) {
        Triangle first{q[0], q[1], q[2]}, second{q[0], q[2], q[3]};
        if (flipFirst) std::swap(first[0], first[2]);
        if (flipSecond) std::swap(second[1], second[2]);
        CHECK(picture(corners, {first, second}) == expected);
      }
    }
  }
}

TEST_CASE("a triangle between samples covers none and one around a sample covers it") {
  const std::vector<std::string> none(4, "........");
  CHECK(picture({{2.625f, 0.625f}, {3.375f, 0.625f}, {2.625f, 1.375f}}, {{0, 1, 2}}) == none);
  CHECK(picture({{2.375f, 1.375f}, {2.75f, 1.375f}, {2.375f, 1.75f}}, {{0, 1, 2}})[1] == "..1.....");
  // A vertex on a sample: covered as the top left end of its two edges, not as the bottom right one.
  CHECK(picture({{2.5f, 1.5f}, {3.25f, 1.5f}, {2.5f, 2.25f}}, {{0, 1, 2}})[1] == "..1.....");
  CHECK(picture({{2.5f, 1.5f}, {1.75f, 1.5f}, {2.5f, 0.75f}}, {{0, 1, 2}})[1] == "........");
}

TEST_CASE("hits count each triangle on a sample") {
  const std::vector<PixelVertex> corners{{0, 0}, {4, 0}, {4, 4}, {0, 4}};
  const std::vector<std::string> expected{"2221....", "1211....", "1.11....", "...1...."};
  CHECK(picture(corners, {{0, 1, 2}, {0, 1, 3}}) == expected);
  CHECK(oracle::render(inPixels(8, 4, corners, {{0, 1, 2}, {0, 1, 3}})).counts.covered == 16);
}

TEST_CASE("every sample of a closed rotated grid is hit exactly once") {
  constexpr int kQuads = 57;
  constexpr std::uint32_t kSize = 256;
  for (const double degrees : {0.0, 1.0, 30.0, 45.0, 73.3}) {
    std::vector<PixelVertex> vertices;
    std::vector<Triangle> triangles;
    const double angle = degrees * std::numbers::pi / 180, pitch = 8;
    for (int v = 0; v <= kQuads; ++v) {
      for (int u = 0; u <= kQuads; ++u) {
        const double x = (u - kQuads / 2.0) * pitch, y = (v - kQuads / 2.0) * pitch;
        vertices.push_back({static_cast<float>(128 + x * std::cos(angle) - y * std::sin(angle)),
                            static_cast<float>(128 + x * std::sin(angle) + y * std::cos(angle))});
      }
    }
    for (std::uint32_t v = 0; v < kQuads; ++v) {
      for (std::uint32_t u = 0; u < kQuads; ++u) {
        const std::uint32_t a = v * (kQuads + 1) + u, b = a + 1, c = a + kQuads + 2, d = a + kQuads + 1;
        if ((u + v) % 2)
          triangles.insert(triangles.end(), {{a, b, c}, {a, c, d}});
        else
          triangles.insert(triangles.end(), {{a, b, d}, {b, c, d}});
      }
    }
    CAPTURE(degrees);
    const auto result = oracle::render(inPixels(kSize, kSize, vertices, triangles));
    CHECK(allHitOnce(result.image));
    CHECK(result.counts.covered == kSize * kSize);
  }
}

TEST_CASE("every sample of a closed fan of 100 thousand slivers is hit exactly once") {
  constexpr std::uint32_t kWidth = 1024, kHeight = 512, kSlivers = 100'000;
  // The rim runs along a rectangle around the raster; the hub lies on a sample.
  const double left = -8, top = -8, wide = kWidth + 16, tall = kHeight + 16;
  std::vector<PixelVertex> vertices{{300.5f, 200.5f}};
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i < kSlivers; ++i) {
    double s = 2 * (wide + tall) * i / kSlivers;
    double x = left, y = top;
    if (s < wide)
      x += s;
    else if ((s -= wide) < tall)
      x += wide, y += s;
    else if ((s -= tall) < wide)
      x += wide - s, y += tall;
    else
      y += tall - (s - wide);
    vertices.push_back({static_cast<float>(x), static_cast<float>(y)});
    triangles.push_back({0, i + 1, (i + 1) % kSlivers + 1});
  }
  // A sliver that cuts a corner of the rectangle is far thinner than the 8 pixels between rim and raster.
  const auto result = oracle::render(inPixels(kWidth, kHeight, vertices, triangles));
  CHECK(allHitOnce(result.image));
  CHECK(result.counts.zeroArea < 10);
}

TEST_CASE("the interval of each row is what testing pixel by pixel gives") {
  std::mt19937 random(7);
  const auto below = [&](std::uint32_t n) { return random() % n; };
  constexpr std::uint32_t kSize = 32;
  std::uint64_t covered = 0;
  for (int round = 0; round < 20'000; ++round) {
    // A third each: any 1/256 position, pixel centres and corners (edges run through samples), far outside.
    std::vector<PixelVertex> vertices;
    for (int v = 0; v < 3; ++v) {
      const auto coordinate = [&] {
        switch (below(3)) {
          case 0:
            return static_cast<float>(below(kSize * 256)) / 256;
          case 1:
            return static_cast<float>(below(kSize * 2)) / 2;
          default:
            return static_cast<float>(below(4096)) / 2 - 1024;
        }
      };
      const float x = coordinate(), y = coordinate();
      vertices.push_back({x, y, static_cast<float>(below(1025)) / 1024});
    }
    const Scene scene = inPixels(kSize, kSize, vertices, {{0, 1, 2}});
    const auto result = oracle::render(scene);
    const auto pieces = oracle::pieces(scene, {});
    if (pieces.empty()) {
      REQUIRE(result.counts.zeroArea == 1);
      continue;
    }
    REQUIRE(pieces.size() == 1);
    const oracle::Piece& t = pieces[0];
    std::uint64_t wrong = 0;
    for (std::uint32_t j = 0; j < kSize; ++j) {
      for (std::uint32_t i = 0; i < kSize; ++i) {
        bool inside = true;
        for (int a = 0; a < 3; ++a) {
          // Coordinates stay below 2^19 here, so 64 bits are plenty.
          const int b = (a + 1) % 3;
          const std::int64_t dx = t.x[b] - t.x[a], dy = t.y[b] - t.y[a];
          const std::int64_t px = 256 * std::int64_t{i} + 128, py = 256 * std::int64_t{j} + 128;
          const std::int64_t e = dx * (py - t.y[a]) - dy * (px - t.x[a]);
          inside &= e > 0 || (e == 0 && ((dy == 0 && dx > 0) || dy < 0));
        }
        wrong += result.image.hits[j * kSize + i] != (inside ? 1u : 0u);
        covered += inside;
      }
    }
    REQUIRE(wrong == 0);
  }
  CHECK(covered > 100'000);  // the comparison was not over empty rasters
}
