// Values by hand: what an orthographic and a perspective raster of values hold, how far from exact, and the cells of an
// integer-vertex height field.
#include <tessera/input.h>
#include <tessera/oracle.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "tests/reference/in-pixels.h"
#include "tests/support/compare.h"
#include "tests/support/machines.h"
#include "tests/support/streams.h"

using namespace tessera;
using namespace tessera::test;
using oracle::Fill, oracle::ImageAxes;

namespace {

constexpr double kUnit = 0x1p-24;

/// A grid of columns x rows vertices, each on the sample of its own pixel, with a height each.
Scene heightField(std::uint32_t columns, std::uint32_t rows) {
  std::mt19937 random(columns * 7919 + rows);
  std::vector<PixelVertex> vertices;
  std::vector<Triangle> triangles;
  Scene scene;
  for (std::uint32_t y = 0; y < rows; ++y)
    for (std::uint32_t x = 0; x < columns; ++x) {
      vertices.push_back({static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f});
      attributeOf(scene).push_back(static_cast<float>(random() * 0x1p-20 - 1500));
      if (x + 1 == columns || y + 1 == rows) continue;
      const std::uint32_t a = y * columns + x;
      triangles.push_back({a, a + columns, a + 1});
      triangles.push_back({a + 1, a + columns, a + columns + 1});
    }
  Scene placed = inPixels(columns, rows, vertices, triangles);
  attributeOf(placed) = attributeOf(scene);
  nameAttribute(placed, "height");
  return placed;
}

}  // namespace

TEST_CASE("Linear on the screen without perspective and by the plane's own coordinates with it", "[attributes]") {
  // A ramp of 0 to 8 over 8 pixels; the vertices reach beyond the raster.
  Scene ramp = inPixels(8, 2, {{0, 0}, {8, 0}, {0, 8}, {8, 8}}, {{0, 2, 1}, {1, 2, 3}});
  attributeOf(ramp) = {0, 8, 0, 8};
  const auto flat = oracle::render(ramp);
  for (std::uint32_t k = 0; k < 16; ++k) CHECK(valuesOf(flat.image)[k] == static_cast<float>(k % 8) + 0.5f);
  CHECK(oracle::attributeError(ramp, {}, flat.image).max == 0);
  // The right side three times as far: at screen position s of 0 to 1 the value is 8 (s/3) / ((1 - s) + s/3).
  for (const int v : {1, 3}) ramp.clip[v] *= 3.0f;
  const auto steep = oracle::render(ramp);
  for (std::uint32_t k = 0; k < 16; ++k) {
    const double s = (k % 8 + 0.5) / 8;
    CHECK(valuesOf(steep.image)[k] == Approx(8 * (s / 3) / ((1 - s) + s / 3)).epsilon(1e-6));
  }
}

TEST_CASE("Errors without perspective are within six roundings of the largest value", "[attributes]") {
  std::mt19937 random(5);
  const auto uniform = [&](double scale) { return static_cast<float>(random() * 0x1p-32 * scale); };
  double worst = 0;
  for (int round = 0; round < 2000; ++round) {
    const double size = round % 3 == 0 ? 2 : round % 3 == 1 ? 64 : 4096;
    std::vector<PixelVertex> v;
    for (int k = 0; k < 3; ++k) v.push_back({32 + uniform(size) - uniform(size), 32 + uniform(size) - uniform(size)});
    Scene scene = inPixels(64, 64, v, {{0, 1, 2}});
    for (int k = 0; k < 3; ++k) attributeOf(scene).push_back(uniform(200) - 100);
    const auto result = oracle::render(scene);
    const auto error = oracle::attributeError(scene, {}, result.image);
    const auto [least, most] = std::ranges::minmax(attributeOf(scene));
    const double bound = 6 * kUnit * std::max(std::abs(least), std::abs(most)) * 1.001;
    CHECK(error.max <= bound);
    CHECK(error.rms <= error.max);
    worst = std::max(worst, error.max / bound);
  }
  CHECK(worst > 0.2);  // so the bound says something
}

TEST_CASE("The error of a raster of values is that of its values", "[attributes]") {
  Scene ramp = inPixels(4, 1, {{0, 0}, {4, 0}, {0, 4}, {4, 4}}, {{0, 2, 1}, {1, 2, 3}});
  attributeOf(ramp) = {0, 4, 0, 4};
  Framebuffer frame = oracle::render(ramp).image;
  valuesOf(frame)[1] += 0.25f;
  valuesOf(frame)[2] -= 0.5f;
  const auto error = oracle::attributeError(ramp, {}, frame);
  CHECK(error.pixels == 4);
  CHECK(error.max == 0.5);
  CHECK(error.rms == Approx(std::sqrt((0.0625 + 0.25) / 4)));
  valuesOf(frame)[0] = std::nanf("");
  CHECK(std::isinf(oracle::attributeError(ramp, {}, frame).max));
}

PLACE_TEST_CASE("A height field of integer vertices has each vertex' value at its pixel", "[attributes]") {
  const oracle::ImageAxes cells{.fill = oracle::Fill::kInclusive, .subPixelBits = 0};
  for (const auto& [columns, rows] : {std::pair{64u, 64u}, {97u, 31u}, {2u, 200u}, {333u, 5u}}) {
    const Scene scene = heightField(columns, rows);
    INFO(columns << " x " << rows);
    const Framebuffer oracle = oracle::render(scene, cells).image;
    CHECK(valuesOf(oracle) == attributeOf(scene));  // to the outermost row and column
    const Framebuffer image = machine.render(scene, {{"fill", "inclusive"}, {"sub-pixel", "0"}}).image;
    CHECK(valuesOf(image) == attributeOf(scene));
    CHECK(difference(image, oracle) == "");
  }
}
