// size-class=shape: pieces of every shape, at every place of a tile, against the oracle, on each device that has the
// value and at each width of lanes.
#include <tessera/oracle.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "tests/support/compare.h"
#include "tests/support/machines.h"

using namespace tessera;
using namespace tessera::test;

namespace {

constexpr std::uint32_t kSize = 192;  // 3 x 3 tiles of 64 pixels
using Random = std::mt19937;

struct Point {
  double x, y;
};

float between(Random& random, float low, float high) {
  return std::uniform_real_distribution<float>(low, high)(random);
}

/// A triangle of which the corners are given in pixels, with depths by chance: equal ones, too.
void add(Scene& scene, Random& random, const Point (&corners)[3]) {
  const auto first = static_cast<std::uint32_t>(scene.clip.size());
  const float depth = float(random() % 4) / 4;
  const bool flat = random() % 2 == 0;
  for (const Point& p : corners) {
    const float z = flat ? depth : between(random, 0, 1);
    scene.clip.emplace_back(float(p.x / (kSize / 2.0) - 1), float(p.y / (kSize / 2.0) - 1), z, 1.0f);
  }
  if (random() % 2)
    scene.triangles.push_back({first, first + 1, first + 2});
  else
    scene.triangles.push_back({first + 2, first + 1, first});
}

/// From (x, y) along an angle: `length` pixels long, `across` pixels wide.
void addSliver(Scene& scene, Random& random, Point from, double angle, double length, double across) {
  const double dx = std::cos(angle), dy = std::sin(angle), at = between(random, 0, 1) * length;
  add(scene, random,
      {from,
       {from.x + dx * length, from.y + dy * length},
       {from.x + dx * at - dy * across, from.y + dy * at + dx * across}});
}

Scene empty() {
  Scene scene;
  scene.width = scene.height = kSize;
  return scene;
}

/// Tiny, thin and large pieces around every corner and side of the middle tile, and thin ones at all angles.
Scene everywhere(Random& random) {
  Scene scene = empty();
  for (const double y : {63.0, 64.0, 65.0, 96.0, 127.0, 128.0, 129.0})
    for (const double x : {63.0, 64.0, 65.0, 96.0, 127.0, 128.0, 129.0}) {
      const Point p{x + between(random, -1, 1), y + between(random, -1, 1)};
      const double angle = between(random, 0, 6.3f);
      addSliver(scene, random, p, angle, 3, 2);                          // tiny
      addSliver(scene, random, p, angle, 40, between(random, 0, 1.2f));  // thin, or nearly
      addSliver(scene, random, p, angle, 90, 60);                        // neither
    }
  for (int k = 0; k < 200; ++k)
    addSliver(scene, random, {between(random, -60, 250), between(random, -60, 250)}, k * 0.0314159265358979,
              between(random, 5, 300), between(random, 0, 1));
  return scene;
}

/// Pieces that reach far beyond the raster, to the guard band and behind it: thin ones, and such as cover everything.
Scene farOut(Random& random) {
  Scene scene = empty();
  for (int k = 0; k < 300; ++k) {
    const double angle = between(random, 0, 6.3f), reach = std::exp2(between(random, 8, 17));
    const Point aim{between(random, 0, kSize), between(random, 0, kSize)};
    addSliver(scene, random, {aim.x - std::cos(angle) * reach / 2, aim.y - std::sin(angle) * reach / 2}, angle, reach,
              k % 5 == 0 ? reach : between(random, 0, 1));
  }
  return scene;
}

/// As many pieces in one tile as a round has, one more, one less, four rounds and one.
Scene some(Random& random, int pieces) {
  Scene scene = empty();
  for (int k = 0; k < pieces; ++k)
    addSliver(scene, random, {between(random, 66, 120), between(random, 66, 120)}, between(random, 0, 6.3f),
              between(random, 1, 50), k % 3 == 0 ? between(random, 0, 0.8f) : between(random, 1, 40));
  return scene;
}

/// Depths that lie so close together that 256 over their range is no number.
Scene nearlyFlat(Random& random) {
  Scene scene = some(random, 100);
  for (std::size_t i = 0; i < scene.clip.size(); ++i) scene.clip[i].z = float(i % 7) * 1e-38f;
  return scene;
}

std::vector<Scene> scenes() {
  Random random(20261129);
  std::vector<Scene> all{everywhere(random), farOut(random)};
  for (const int pieces : {1, 3, 4, 5, 7, 8, 9, 15, 16, 17, 33, 63, 64, 65, 257, 600}) all.push_back(some(random, pieces));
  all.push_back(nearlyFlat(random));
  return all;
}

}  // namespace

CHECKED_PLACE_TEST_CASE("Shapes at all places give the oracle's bits", "") {
  std::vector<Variant> variants;
  for (const char* const settings : {"", "hidden=off", "hidden=tile order=nearest-first", "order=nearest-first", "tile=8", "tile=16",
                                     "binning=aabb-scan", "binning=bitmask hidden=off", "fill=inclusive"})
    variants.emplace_back("size-class=shape " + std::string(settings));
  if (machine.info().threads > 0)
    for (const char* const width : {"4", "8", "16"}) variants.emplace_back(std::string("size-class=shape lane-width=") + width);
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  const bool few = true;  // kernels compile several times as long
#else
  const bool few = machine.info().correctnessOnly || machine.name() == CheckedCpu::kName;
#endif
  std::size_t index = 0;
  for (const Scene& scene : scenes()) {
    for (std::size_t i = 0; i < variants.size(); ++i) {
      if (few && i % 3 != index % 3) continue;
      INFO("scene " << index << ", " << variants[i].text());
      CHECK(difference(machine.render(scene, variants[i]).image,
                       oracle::render(scene, oracle::imageAxesOf(variants[i])).image) == "");
    }
    ++index;
  }
}

TEST_CASE("What hides and in which order changes counters and no bit") {
  Random random(7);
  Scene scene = empty();
  for (int k = 0; k < 400; ++k)
    addSliver(scene, random, {between(random, 0, kSize), between(random, 0, kSize)}, between(random, 0, 6.3f), 80, 60);
  Machine& machine = *machineAt<Cpu>();
  const oracle::Result right = oracle::render(scene);
  std::vector<std::uint64_t> covered;
  for (const char* const settings : {"hidden=off order=as-binned", "hidden=tile order=as-binned", "hidden=cell order=as-binned",
                                     "hidden=cell order=nearest-first"}) {
    INFO(settings);
    const Frame frame = machine.render(scene, Variant("size-class=shape counters=work " + std::string(settings)));
    CHECK(difference(frame.image, right.image) == "");
    covered.push_back(frame.counters.at("covered"));
  }
  CHECK(covered[0] == right.counts.covered);
  CHECK(covered[1] <= covered[0]);
  CHECK(covered[2] < covered[1]);
  CHECK(covered[3] < covered[2]);
}

