// Approximate values err where theory says so, within the bound that their files derive, and alike on every device.
#include <tessera/input.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "datasets/random.h"
#include "host/oracle/oracle-image.h"
#include "tests/support/compare.h"
#include "tests/support/machines.h"

using namespace tessera;
using namespace tessera::test;

namespace {

/// One triangle on a raster of 512 x 512, with a sample exactly on the middle of its first edge, where the exact E is 0 and
/// the terms of the plane equation have more than 24 bits to cancel.
Scene triangleThroughSample(datasets::Random& random) {
  const auto below = [&](std::uint64_t n) { return static_cast<int>(random.bits() % n); };
  const int x = 256 * (128 + below(256)) + 128, y = 256 * (128 + below(256)) + 128;  // 1/256 pixel
  const int dx = below(30000) - 15000, dy = below(30000) - 15000;
  Scene scene;
  scene.width = scene.height = 512;
  for (const auto& [px, py] : {std::pair{x - dx, y - dy}, {x + dx, y + dy}, {below(131072), below(131072)}})
    scene.clip.emplace_back(static_cast<float>(px) / 65536 - 1, static_cast<float>(py) / 65536 - 1, 0.5f, 1.0f);
  scene.triangles = {{0, 1, 2}};
  return scene;
}

/// |E| of an edge at a sample, and the bound of edge/float32-plane.slang or edge/float32-difference.slang there, in units of
/// 1/256 pixel, computed in numbers that hold them exactly.
struct EdgeAt {
  double value, bound;
};
EdgeAt edgeAt(const oracle::Piece& p, int a, int b, double x, double y, bool plane) {
  const double dx = p.y[a] - p.y[b], dy = p.x[b] - p.x[a];
  const double u = 0x1p-24;
  const double value = dx * (x - p.x[a]) + dy * (y - p.y[a]);
  const double bound = plane ? 6 * u * (std::abs(dx) * (x + std::abs(p.x[a])) + std::abs(dy) * (y + std::abs(p.y[a])))
                             : 5 * u * (std::abs(dx * (x - p.x[a])) + std::abs(dy * (y - p.y[a])));
  return {std::abs(value), bound};
}

/// Whether some edge is so close to the sample that its arithmetic may be wrong there.
bool mayErr(const oracle::Piece& p, std::size_t pixel, std::size_t width, bool plane) {
  const double x = 256.0 * static_cast<double>(pixel % width) + 128, y = 256.0 * static_cast<double>(pixel / width) + 128;
  for (int a = 0; a < 3; ++a)
    if (const EdgeAt e = edgeAt(p, a, (a + 1) % 3, x, y, plane); e.value <= e.bound) return true;
  return false;
}

double largestDifference(const std::vector<float>& a, const std::vector<float>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(double(a[i]) - double(b[i])));
  return largest;
}

/// A hundred layers that are nearer together than 1/65535, the lower id always farther.
Scene closeLayers() {
  Scene scene;
  scene.width = scene.height = 64;
  for (int i = 0; i < 100; ++i) {
    const float z = 0.50001f - static_cast<float>(i) * 1e-7f;
    const auto first = static_cast<std::uint32_t>(scene.clip.size());
    for (const auto& [x, y] : {std::pair{-1.0f, -1.0f}, {3.0f, -1.0f}, {-1.0f, 3.0f}}) scene.clip.emplace_back(x, y, z, 1.0f);
    scene.triangles.push_back({first, first + 1, first + 2});
  }
  return scene;
}

}  // namespace

PLACE_TEST_CASE("Float32 edges are wrong near edges only and somewhere", "[approximate]") {
  datasets::Random random(7);
  std::size_t wrongPlane = 0, wrongDifference = 0;
  const int triangles = machine.info().api == "cpu" ? 300 : 100;  // some 7 of 100 err
  for (int i = 0; i < triangles; ++i) {
    const Scene scene = triangleThroughSample(random);
    const auto pieces = oracle::pieces(scene, {});
    if (pieces.empty()) continue;
    const std::vector<std::uint32_t> exact = oracle::render(scene).image.hits;
    for (const bool plane : {true, false}) {
      const char* const edge = plane ? "float32-plane" : "float32-difference";
      const std::vector<std::uint32_t> hits = machine.render(scene, {{"commit", "count"}, {"edge", edge}}).image.hits;
      for (std::size_t k = 0; k < hits.size(); ++k) {
        if (hits[k] == exact[k]) continue;
        ++(plane ? wrongPlane : wrongDifference);
        if (!mayErr(pieces[0], k, scene.width, plane)) FAIL("triangle " << i << ", " << edge << ": pixel " << k << " is out of bounds");
      }
    }
  }
  CHECK(wrongPlane > 0);
  CHECK(wrongPlane > wrongDifference);  // whose terms are equal where E is 0, so that they cancel exactly
}

PLACE_TEST_CASE("Float32 edges do not depend on tile or traversal or binning", "[approximate]") {
  const Scene scene = loadInput("generate:slivers?count=300", 512, 512);
  std::size_t turn = 0;
  for (const char* const edge : {"float32-plane", "float32-difference"}) {
    const Framebuffer first = machine.render(scene, {{"edge", edge}}).image;
    for (const Variant& variant : {Variant{{"tile", "8"}}, {{"traversal", "pixel"}}, {{"traversal", "hierarchical"}},
                                   {{"traversal", "scanline"}}, {{"size-class", "on"}}, {{"binning", "none"}},
                                   {{"binning", "bitmask"}, {"tile", "16"}}}) {
      // Each has a kernel of its own to compile: on Vulkan the two edges take turns (seven variants, so that none is left out).
      if (machine.info().api != "cpu" && ++turn % 2 == 0) continue;
      Variant with = variant;
      with.set("edge", edge);
      INFO(with.text());
      CHECK(difference(machine.render(scene, with).image, first) == "");
    }
  }
}

/// Of a closed surface seen from outside, backs culled, each sample has one piece: what is left is the packing's own error.
PLACE_TEST_CASE("Packed depths are within their bounds and not exact", "[approximate]") {
  const Scene scene = loadInput("generate:icosphere?level=3", 256, 256);
  const Framebuffer exact = machine.render(scene, {{"cull", "back"}}).image;
  const auto errorOf = [&](const char* commit) {
    return largestDifference(machine.render(scene, {{"commit", commit}, {"cull", "back"}}).image.depth, exact.depth);
  };
  CHECK(errorOf("depth16+id16") > 1e-6);
  CHECK(errorOf("depth16+id16") <= 0.5 / 65535 + 0x1p-23);
  CHECK(errorOf("depth24+lum8") > 0);
  CHECK(errorOf("depth24+lum8") <= 0x1p-23);
  CHECK(errorOf("depth32+rgba8") == 0);
}

PLACE_TEST_CASE("Packed colours are within half a step of the exact ones", "[approximate]") {
  const Scene scene = loadInput("generate:icosphere?level=3", 256, 256);
  const auto colours = [&](const char* commit) {
    return machine.render(scene, {{"commit", commit}, {"shade", "flat"}, {"cull", "back"}}).image.colour;
  };
  const auto exact = colours("tile-owned"), rgba = colours("depth32+rgba8"), grey = colours("depth24+lum8");
  double worstColour = 0, worstGrey = 0;
  for (std::size_t k = 0; k < exact.size(); ++k) {
    for (int c = 0; c < 3; ++c) worstColour = std::max(worstColour, std::abs(double(rgba[k][c]) - exact[k][c]));
    const double luminance = 0.2126 * exact[k].x + 0.7152 * exact[k].y + 0.0722 * exact[k].z;
    worstGrey = std::max(worstGrey, std::abs(grey[k].x - luminance));
  }
  CHECK(worstColour > 0);
  CHECK(worstColour <= 0.5 / 255 + 0x1p-20);
  CHECK(worstGrey > 0);
  CHECK(worstGrey <= 0.5 / 254 + 0x1p-20);
}

PLACE_TEST_CASE("Packed depths confuse what is closer than a step", "[approximate]") {
  const Scene scene = closeLayers();
  const Framebuffer exact = machine.render(scene).image;
  CHECK(exact.ids[0] == 99);
  CHECK(machine.render(scene, {{"commit", "depth16+id16"}}).image.ids[0] == 0);   // all in one step: the lowest id
  const auto colourOf = [&](const Variant& variant) { return machine.render(scene, variant).image.colour[0]; };
  CHECK(colourOf({{"commit", "depth24+lum8"}, {"shade", "id"}}).x > 0);
  // 24 bits are 6e-8 apart: the nearest layer shares its step with one or two others, of which the darkest wins.
  const Framebuffer packed = machine.render(scene, {{"commit", "depth24+lum8"}, {"shade", "id"}}).image;
  CHECK(std::abs(packed.depth[0] - exact.depth[0]) <= 0x1p-23);
}

TEST_CASE("Approximate values are the same on every device", "[approximate]") {
  Machine* const cpu = machineAt<Cpu>();
  const Scene scene = loadInput("generate:soup?count=500&pixels=2000", 256, 256);
  for (const Axis& axis : allAxes())
    for (const AxisValue& value : axis.values) {
      if (value.kind != AxisKind::kApproximate || axis.name == "overflow") continue;  // what drop loses varies
      const Variant variant{{axis.name, value.name}};
      INFO(variant.text());
      CHECK(isApproximate(variant));
      const Framebuffer first = cpu->render(scene, variant).image;
      for (Machine* const other : {machineAt<VulkanSpirv>(), machineAt<VulkanGlsl>()})
        if (other) CHECK(difference(other->render(scene, variant).image, first) == "");
    }
}
