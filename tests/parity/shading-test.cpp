// Colours: the same bits on every machine, and the right ones.
#include <tessera/input.h>

#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "host/frame/lighting.h"
#include "tests/support/compare.h"
#include "tests/support/machines.h"
#include "tests/support/streams.h"

using namespace tessera;
using namespace tessera::test;

namespace {

/// Torus from near by: strong perspective, and part of it behind the eye.
Scene nearTorus() {
  Scene scene = loadInput("generate:torus?rings=24&sides=12", 333, 257);
  scene.clipFromObject = {1.7f, 0.3f, 0, 0.2f, 0.1f, -2.1f, 0.4f, 0, 0.2f, 0.3f, -1.01f, 0.6f, 0.2f, 0.3f, -1, 0.8f};
  return scene;
}

/// Normal of vertex normals weighed by the original triangle's plane coordinates, in double precision.
std::array<double, 3> smoothNormal(const Scene& scene, const Triangle& t, double x, double y) {
  const Matrix& m = scene.clipFromObject;
  double c[3][3];  // x, y, w of each corner
  for (int k = 0; k < 3; ++k) {
    const glm::vec3 p = scene.positions[t[k]];
    const int rows[] = {0, 1, 3};
    for (int r = 0; r < 3; ++r)
      c[k][r] = double(m[4 * rows[r]]) * p.x + double(m[4 * rows[r] + 1]) * p.y + double(m[4 * rows[r] + 2]) * p.z +
                m[4 * rows[r] + 3];
  }
  const double px = (x - scene.width / 2.0) / (scene.width / 2.0), py = (y - scene.height / 2.0) / (scene.height / 2.0);
  const auto weight = [&](int a, int b) {
    return px * (c[a][1] * c[b][2] - c[b][1] * c[a][2]) + py * (c[a][2] * c[b][0] - c[b][2] * c[a][0]) +
           (c[a][0] * c[b][1] - c[b][0] * c[a][1]);
  };
  const double w[] = {weight(1, 2), weight(2, 0), weight(0, 1)}, sum = w[0] + w[1] + w[2];
  std::array<double, 3> n{};
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i) n[i] += w[k] / sum * scene.stream(kNormals)->values[3 * t[k] + i];
  return n;
}

}  // namespace

PLACE_TEST_CASE("Shading has the same bits on every machine", "[shading]") {
  Machine& cpu = *machineAt<Cpu>();
  for (const char* shade : {"id", "flat", "smooth"})
    for (const char* binning : {"exact", "none"}) {
      const Variant variant{{"shade", shade}, {"binning", binning}};
      INFO(variant.text());
      const Scene scene = nearTorus();
      const Frame frame = machine.render(scene, variant);
      REQUIRE(frame.image.colour.size() == frame.image.pixels());
      CHECK(frame.counters.at("clipped") > 0);
      // On the CPU: against the same by another path.
      Variant other = variant;
      if (machine.info().api == "cpu") other.set("binning", std::string(binning) == "none" ? "queue" : "none");
      CHECK(difference(frame.image, cpu.render(scene, other).image) == "");
    }
}

PLACE_TEST_CASE("An empty pixel is white and ids tell neighbours apart", "[shading]") {
  const Scene scene = loadInput("generate:torus?rings=24&sides=12", 333, 257);
  const Framebuffer image = machine.render(scene, {{"shade", "id"}}).image;
  std::size_t empty = 0, neighbours = 0, alike = 0;
  for (std::size_t k = 1; k < image.pixels(); ++k) {
    empty += image.ids[k] == kNoTriangle;
    CHECK((image.ids[k] == kNoTriangle) == (image.colour[k] == glm::vec3(1, 1, 1)));
    if (image.ids[k] == image.ids[k - 1]) continue;
    ++neighbours;
    alike += image.colour[k] == image.colour[k - 1];
  }
  CHECK(empty > 1000);
  CHECK(neighbours > 1000);
  CHECK(alike == 0);
}

PLACE_TEST_CASE("Smooth normals are perspective-correct", "[shading]") {
  const Scene scene = nearTorus();
  const Framebuffer image = machine.render(scene, {{"shade", "smooth"}}).image;
  const auto [light, eye] = frame::lightingOf(scene.clipFromObject);
  std::size_t checked = 0, off = 0;
  for (std::size_t k = 0; k < image.pixels(); ++k) {
    if (image.ids[k] == kNoTriangle) continue;
    const Triangle& t = scene.triangles[image.ids[k]];
    const auto n = smoothNormal(scene, t, double(k % image.width) + 0.5, double(k / image.width) + 0.5);
    const glm::vec3 at = scene.positions[t[0]];
    const double toEye[] = {eye[0] - double(eye[3]) * at.x, eye[1] - double(eye[3]) * at.y,
                            eye[2] - double(eye[3]) * at.z};
    const double size = std::hypot(n[0], n[1], n[2]);
    const double facing =
        (n[0] * toEye[0] + n[1] * toEye[1] + n[2] * toEye[2]) / (size * std::hypot(toEye[0], toEye[1], toEye[2]));
    const double lit = (n[0] * light[0] + n[1] * light[1] + n[2] * light[2]) / size * (facing < 0 ? -1 : 1);
    const double expected =
        0.04 + 0.26 * std::abs(facing) + 0.7 * std::max(lit, 0.0);  // slang/stages/shade.slang: lambert
    ++checked;
    off += std::abs(image.colour[k].x / 0.62 - expected) > 0.001;
  }
  CHECK(checked > 4000);
  // A pixel whose centre lies off its triangle by the snapping has a weight of 0 for a slightly negative one; and where
  // the eye sees the surface edge on, the side that is lit is a matter of rounding.
  CHECK(off < checked / 50);
}
