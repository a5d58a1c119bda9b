// Colours: the same bits on every machine, and the right ones.
#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "datasets/input.h"
#include "tests/support/compare.h"
#include "tests/support/machines.h"

using namespace tessera;

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
  double c[3][3];   // x, y, w of each corner
  for (int k = 0; k < 3; ++k) {
    const glm::vec3 p = scene.positions[t[k]];
    const int rows[] = {0, 1, 3};
    for (int r = 0; r < 3; ++r) c[k][r] = double(m[4 * rows[r]]) * p.x + double(m[4 * rows[r] + 1]) * p.y + double(m[4 * rows[r] + 2]) * p.z + m[4 * rows[r] + 3];
  }
  const double px = (x - scene.width / 2.0) / (scene.width / 2.0), py = (y - scene.height / 2.0) / (scene.height / 2.0);
  const auto weight = [&](int a, int b) {
    return px * (c[a][1] * c[b][2] - c[b][1] * c[a][2]) + py * (c[a][2] * c[b][0] - c[b][2] * c[a][0]) + (c[a][0] * c[b][1] - c[b][0] * c[a][1]);
  };
  const double w[] = {weight(1, 2), weight(2, 0), weight(0, 1)}, sum = w[0] + w[1] + w[2];
  std::array<double, 3> n{};
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i) n[i] += w[k] / sum * scene.normals[t[k]][i];
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
  const auto cosineAt = [&](std::size_t k) { return (image.colour[k].x / 0.62 - 0.06) / 0.94; };
  // The light of rasterizer.cpp, from the matrix: towards the viewer, from above and a little from the left.
  const Matrix& m = scene.clipFromObject;
  const auto row = [&](int r, double sign) {
    const double length = std::hypot(m[4 * r], m[4 * r + 1], m[4 * r + 2]);
    return std::array{sign * m[4 * r] / length, sign * m[4 * r + 1] / length, sign * m[4 * r + 2] / length};
  };
  const auto forward = row(3, 1), right = row(0, 1), up = row(1, -1);
  std::array<double, 3> light{};
  for (int i = 0; i < 3; ++i) light[i] = -forward[i] + 0.55 * up[i] - 0.45 * right[i];
  const double length = std::hypot(light[0], light[1], light[2]);
  std::size_t checked = 0;
  double worst = 0;
  for (std::size_t k = 0; k < image.pixels(); ++k) {
    if (image.ids[k] == kNoTriangle) continue;
    const auto n = smoothNormal(scene, scene.triangles[image.ids[k]], double(k % image.width) + 0.5, double(k / image.width) + 0.5);
    const double expected = std::abs(n[0] * light[0] + n[1] * light[1] + n[2] * light[2]) / (std::hypot(n[0], n[1], n[2]) * length);
    ++checked;
    worst = std::max(worst, std::abs(cosineAt(k) - expected));
  }
  CHECK(checked > 4000);
  // A pixel whose centre lies off its triangle by the snapping takes a weight of 0 for a slightly negative one.
  CHECK(worst < 0.02);
}
