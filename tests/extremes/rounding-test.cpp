// Numbers at the ends of float32, where rounding is coarse: tiny and huge w, denormals, polygons that rounding bends.
#include <catch2/catch.hpp>
#include <cmath>

#include "datasets/random.h"
#include "host/oracle/reference-clip.h"
#include "tests/support/compare.h"
#include "tests/support/machines.h"
#include "tests/support/variants.h"

using namespace tessera;
using namespace tessera::test;

namespace {

constexpr std::uint64_t kScenes = 60;
constexpr std::size_t kTriangles = 200;

/// Triangles whose coordinates are of wildly different magnitudes; `exponent` draws one.
template <typename Exponent>
Scene scaledScene(std::uint64_t seed, Exponent exponent) {
  datasets::Random random(seed);
  Scene scene;
  scene.width = 1u << random.bits() % 8;
  scene.height = 97;
  const auto coordinate = [&](bool positive) {
    const double size = std::exp2(exponent(random));
    return static_cast<float>(!positive && random.unit() < 0.5 ? -size : size);
  };
  for (std::uint32_t i = 0; i < kTriangles; ++i) {
    for (int corner = 0; corner < 3; ++corner) {
      const float x = coordinate(false), y = coordinate(false), z = coordinate(true), w = coordinate(true);
      scene.clip.emplace_back(x, y, z, w);
    }
    scene.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return scene;
}

template <typename Exponent>
void checkScaled(Machine& machine, Exponent exponent) {
  const auto variants = combinations({"plan", "binning"}, machine.info());
  std::uint64_t clipped = 0, covered = 0;
  for (std::uint64_t seed = 0; seed < kScenes; ++seed) {
    const Scene scene = scaledScene(seed, exponent);
    const oracle::Result oracle = oracle::render(scene);
    clipped += oracle.counts.clipped;
    covered += oracle.counts.covered;
    const Variant& variant = variants[seed % variants.size()];
    INFO("seed " << seed << ", " << variant.text());
    CHECK(difference(machine.render(scene, variant), oracle) == "");
  }
  CHECK(clipped > kScenes * kTriangles / 10);
  CHECK(covered > 0);
}

}  // namespace

CHECKED_PLACE_TEST_CASE("All of float32's magnitudes at once", "[rounding]") {
  checkScaled(machine, [](datasets::Random& r) { return r.between(-149, 128); });
}

CHECKED_PLACE_TEST_CASE("Coordinates about as large as each other, anywhere in float32", "[rounding]") {
  double middle = 0;
  std::uint64_t drawn = 0;
  checkScaled(machine, [&](datasets::Random& r) {
    if (drawn++ % 12 == 0) middle = r.between(-145, 126);
    return middle + r.between(-1.5, 1.5);
  });
}

CHECKED_PLACE_TEST_CASE("Denormal coordinates", "[rounding]") {
  // 1/w is finite from 2^-128 on.
  checkScaled(machine, [](datasets::Random& r) { return r.between(-136, -126); });
}

CHECKED_PLACE_TEST_CASE("Polygons that rounding bends keep all their corners", "[rounding]") {
  // Seeded search with the oracle's clipper. Corners of triangles lie on corners of the clip volume but for the last
  // bits, at w of many magnitudes; of one in 4,000 clipping leaves ten corners, one more than there are planes and
  // corners.
  Scene scene;
  scene.width = scene.height = 64;
  const float guard = 32767.0f / 32;
  datasets::Random random(11);
  const auto side = [&](double size) { return random.unit() < 0.5 ? -size : size; };
  std::size_t searched = 0;
  for (; scene.triangles.size() < 40 && searched < 1000000; ++searched) {
    std::array<glm::vec4, 3> t;
    for (glm::vec4& v : t) {
      const double w = std::exp2(random.between(-40, 40));
      v = glm::vec4(glm::dvec4(side(guard * w), side(guard * w), random.unit() < 0.5 ? 0 : w, w));
      for (int i = 0; i < 4; ++i) v[i] = static_cast<float>(v[i] * (1 + random.between(-3, 3) * 0x1p-23));
    }
    if (oracle::clip(t, scene.width, scene.height).polygon.size() < 10) continue;
    const auto first = static_cast<std::uint32_t>(scene.clip.size());
    scene.clip.own().insert(scene.clip.own().end(), t.begin(), t.end());
    scene.triangles.push_back({first, first + 1, first + 2});
  }
  INFO("searched " << searched);
  CHECK(scene.triangles.size() == 40);
  for (const Variant& variant : combinations({"binning"}, machine.info())) {
    INFO(variant.text());
    CHECK(difference(machine.render(scene, variant), oracle::render(scene)) == "");
  }
}
