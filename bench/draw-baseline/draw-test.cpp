// The baseline draws the scene that it is given: on lavapipe, which snaps as the contract does, the oracle's very
// pixels.
#include "bench/draw-baseline/draw.h"

#include <tessera/error.h>
#include <tessera/oracle.h>

#include <catch2/catch.hpp>
#include <random>

using namespace tessera;

namespace {

/// Within the view: lavapipe clips what crosses its sides there, and the new corners snap to other places.
Scene soup(std::uint32_t triangles, std::uint32_t width, std::uint32_t height) {
  Scene scene;
  scene.width = width;
  scene.height = height;
  std::mt19937 random(7);
  std::uniform_real_distribution<float> place(-1.0f, 1.0f), depth(0.05f, 0.95f);
  for (std::uint32_t i = 0; i < triangles; ++i) {
    for (int corner = 0; corner < 3; ++corner) {
      const float x = place(random), y = place(random), z = depth(random);
      scene.clip.emplace_back(x, y, z, 1.0f);
    }
    scene.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return scene;
}

}  // namespace

TEST_CASE("the draw covers the oracle's pixels on lavapipe") {
  const Scene scene = soup(40, 301, 203);
  bench::DrawBaseline baseline(scene, "llvmpipe", true);
  const Framebuffer drawn = baseline.framebuffer();
  const Framebuffer expected = oracle::render(scene).image;
  REQUIRE(drawn.ids.size() == expected.ids.size());
  std::size_t coverage = 0, ids = 0, depths = 0, covered = 0;
  for (std::size_t i = 0; i < drawn.ids.size(); ++i) {
    coverage += (drawn.ids[i] == kNoTriangle) != (expected.ids[i] == kNoTriangle);
    ids += drawn.ids[i] != expected.ids[i];
    depths += std::abs(drawn.depth[i] - expected.depth[i]) > 1e-3f;
    covered += expected.ids[i] != kNoTriangle;
  }
  CHECK(coverage == 0);
  CHECK(ids <= 21);  // where two depths all but tie
  CHECK(depths <= ids);
  CHECK(covered > drawn.ids.size() / 4);
}

TEST_CASE("the draw is timed on both clocks") {
  bench::DrawBaseline baseline(soup(200, 512, 512), "llvmpipe", true);
  for (int i = 0; i < 3; ++i) {
    const bench::DrawTime time = baseline.time();
    CHECK(time.deviceNs > 1000);
    CHECK(time.deviceNs <= time.wallNs);
  }
}

TEST_CASE("an empty scene is drawn empty and a bad index is refused") {
  Scene scene;
  scene.width = scene.height = 4;
  const Framebuffer frame = bench::DrawBaseline(scene, "llvmpipe").framebuffer();
  CHECK(frame.ids == std::vector<std::uint32_t>(16, kNoTriangle));
  CHECK(frame.depth == std::vector<float>(16, 1.0f));
  scene = soup(1, 4, 4);
  scene.triangles[0][1] = 3;
  CHECK_THROWS_AS(bench::DrawBaseline(scene, "llvmpipe"), Error);
}
