#include "host/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "host/error.h"

namespace tessera {
namespace {

struct Bounds {
  std::array<double, 3> low, high;
  bool empty = true;
};

/// Of the finite positions: the others are dropped in setup.
Bounds boundsOf(const std::vector<glm::vec3>& positions) {
  Bounds b;
  b.low.fill(std::numeric_limits<double>::infinity());
  b.high.fill(-std::numeric_limits<double>::infinity());
  for (const glm::vec3& p : positions) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) continue;
    b.empty = false;
    for (int i = 0; i < 3; ++i) {
      b.low[i] = std::min(b.low[i], double{p[i]});
      b.high[i] = std::max(b.high[i], double{p[i]});
    }
  }
  return b;
}

/// One of the contract's six distances, and how large its terms were: the measure of its rounding error.
struct Distance {
  double value, size;
};
std::array<Distance, 6> distances(const std::array<double, 4>& p, const std::array<double, 4>& size, double guardX,
                                  double guardY) {
  const auto [x, y, z, w] = p;
  const auto [sx, sy, sz, sw] = size;
  return {{{z, sz},
           {w - z, sw + sz},
           {guardX * w + x, guardX * sw + sx},
           {guardX * w - x, guardX * sw + sx},
           {guardY * w + y, guardY * sw + sy},
           {guardY * w - y, guardY * sw + sy}}};
}

/// Whether the contract's float32 arithmetic may find this point of object space outside a clip plane. Transform and
/// distance round a handful of times, each by 2^-24 of the terms: 1e-5 of their sum is ample.
bool mayBeOutside(const Matrix& m, const std::array<double, 3>& point, double guardX, double guardY) {
  std::array<double, 4> p{}, size{};
  for (int row = 0; row < 4; ++row) {
    for (int i = 0; i < 3; ++i) {
      const double term = m[4 * row + i] * point[i];
      p[row] += term;
      size[row] += std::abs(term);
    }
    p[row] += m[4 * row + 3];
    size[row] += std::abs(m[4 * row + 3]);
  }
  return std::ranges::any_of(distances(p, size, guardX, guardY),
                             [](const Distance& d) { return !(d.value > 1e-5 * d.size); });
}

/// Whether a vertex of the scene may lie outside a clip plane.
bool mayCross(const Scene& scene) {
  const double guardX = 32767.0 / (scene.width * 0.5), guardY = 32767.0 / (scene.height * 0.5);
  if (scene.positions.empty())
    return std::ranges::any_of(scene.clip, [&](const glm::vec4& c) {
      // Given, not computed: only the distance itself rounds, and 0 is inside.
      const std::array<double, 4> p{c.x, c.y, c.z, c.w};
      const bool finite = std::ranges::all_of(p, [](double v) { return std::isfinite(v); });
      return finite && std::ranges::any_of(distances(p, {}, guardX * (1 - 1e-6), guardY * (1 - 1e-6)),
                                           [](const Distance& d) { return d.value < 0; });
    });
  const Bounds bounds = boundsOf(scene.positions);
  if (bounds.empty) return false;
  // The planes bound a convex part of object space: if it holds the corners of the box, it holds the scene. Else each
  // vertex is looked at.
  const auto corner = [&](int c) {
    std::array<double, 3> p{};
    for (int i = 0; i < 3; ++i) p[i] = (c >> i) & 1 ? bounds.high[i] : bounds.low[i];
    return p;
  };
  bool boxInside = true;
  for (int c = 0; c < 8; ++c) boxInside = boxInside && !mayBeOutside(scene.clipFromObject, corner(c), guardX, guardY);
  return !boxInside && std::ranges::any_of(scene.positions, [&](const glm::vec3& p) {
    const bool finite = std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
    return finite && mayBeOutside(scene.clipFromObject, {p.x, p.y, p.z}, guardX, guardY);
  });
}

/// Whether every vertex that setup keeps has w = 1 exactly: 0 x is 0 for a finite x, and where x is not finite w is
/// NaN.
bool isOrthographic(const Scene& scene) {
  if (scene.positions.empty()) return std::ranges::all_of(scene.clip, [](const glm::vec4& c) { return c.w == 1.0f; });
  const Matrix& m = scene.clipFromObject;
  return m[12] == 0 && m[13] == 0 && m[14] == 0 && m[15] == 1;
}

class Planner {
 public:
  Planner(const Scene& scene, const Variant& asked, const DeviceInfo& device)
      : scene_(scene), asked_(asked), device_(device), full_(asked.get("plan", "planned") == "full") {}

  Plan run() {
    choose("plan", "planned");
    route();
    geometry();
    bins();
    commit();
    choose("traversal", "cell-reject");
    choose("edge", "int32");
    wide();
    choose("counters", "basic");
    shading();
    attribute();
    return std::move(plan_);
  }

 private:
  std::string choose(std::string_view axis, const std::string& otherwise) {
    const std::string value = asked_.get(axis, otherwise);
    plan_.resolved.set(axis, value);
    return value;
  }
  void note(std::string pass, bool kept, std::string why) {
    plan_.entries.push_back({std::move(pass), kept, std::move(why)});
  }

  void route() {
    const bool cpu = device_.api == "cpu";
    const std::string value = choose("route", cpu ? "cpp" : "spirv");
    if (cpu != (value == "cpp"))
      failUnsupported(fmt::format("route={}: the {} device takes {}", value, device_.api,
                                  cpu ? "route=cpp" : "route=spirv or route=glsl"));
  }

  void geometry() {
    plan_.transform = !scene_.positions.empty();
    note("transform", plan_.transform,
         plan_.transform ? "positions are in object space" : "positions are given in clip space");
    note("project", true, "vertices are snapped once each");
    note("setup", true, "triangles become snapped, oriented pieces");

    const bool crosses = mayCross(scene_);
    plan_.clip = choose("clip", full_ || crosses ? "on" : "off") == "on";
    if (!plan_.clip && crosses)
      failUsage("clip=off: triangles of this scene may cross a clip plane; leave clip unset, or set clip=on");
    note("setup: clip", plan_.clip,
         crosses ? "a triangle may cross a clip plane" : "no triangle can cross a clip plane");

    const bool orthographic = isOrthographic(scene_);
    plan_.perspective = choose("projection", full_ || !orthographic ? "perspective" : "orthographic") == "perspective";
    if (!plan_.perspective && !orthographic)
      failUsage("projection=orthographic: w is not 1 at every vertex of this scene; leave projection unset");
    note("project: perspective division", plan_.perspective, orthographic ? "w is 1 at every vertex" : "w varies");

    const std::string cull = choose("cull", "none");
    note("setup: cull by facing", cull != "none", cull == "none" ? "not asked for (cull)" : "cull=" + cull);
    const bool between = choose("between-samples", full_ ? "off" : "on") == "on";
    note("setup: drop between samples", between,
         between ? "a piece without a sample in its box need not be binned"
                 : "asked to go without (between-samples, plan)");
  }

  void bins() {
    const std::string commit = asked_.get("commit");
    const bool atomic = commit == "depth32+id32" || commit == "two-pass";
    const std::string binning = choose("binning", atomic ? "none" : "exact");
    binned_ = binning != "none";
    int largest = 64;
    while (largest > 8 && tileOwnedBytes(largest) > device_.maxGroupBytes) largest /= 2;
    const int tile = std::stoi(choose("tile", std::to_string(largest)));
    const double tiles = std::ceil(double(scene_.width) / tile) * std::ceil(double(scene_.height) / tile);
    const double mean = 4.0 * double(scene_.triangles.size()) / tiles;
    choose("capacity", std::to_string(std::bit_ceil(static_cast<unsigned>(std::clamp(mean, 16.0, 32768.0)))));
    choose("overflow", "retry");
    note("bin-count, scan", binning == "exact",
         binning == "exact" ? "bins are sized by counting first"
         : binned_          ? "queues have a fixed capacity; only a retry counts and scans"
                            : "no bins (binning=none)");
    note("bin-insert", binned_, binned_ ? "pieces go to the tiles that they touch" : "no bins (binning=none)");
  }

  void commit() {
    const bool atomics64 = device_.int64 && device_.atomicMin64;
    const std::string value = choose("commit", binned_ ? "tile-owned" : atomics64 ? "depth32+id32" : "two-pass");
    if (value == "tile-owned" && !binned_)
      failUsage(
          "commit=tile-owned: needs bins, and binning=none has none; set binning=exact or queue, or "
          "commit=depth32+id32 or two-pass");
    if (value == "depth32+id32" && !atomics64)
      failUnsupported(fmt::format(
          "commit=depth32+id32: {} has no 64-bit atomic min on buffers (shaderBufferInt64Atomics); set commit=two-pass",
          device_.name));
    const std::uint64_t groupMemory = tileOwnedBytes(std::stoul(plan_.resolved.get("tile")));
    if (value == "tile-owned" && groupMemory > device_.maxGroupBytes)
      failUnsupported(fmt::format("tile={}: tile-owned takes {} bytes of group memory, {} has {}; set a smaller tile",
                                  plan_.resolved.get("tile"), groupMemory, device_.name, device_.maxGroupBytes));
    plan_.clear = full_ || value != "tile-owned";
    note("clear", plan_.clear,
         value != "tile-owned" ? "atomics compare with what the frame holds"
         : full_               ? "plan=full"
                               : "each tile writes all of its own pixels");
    note(binned_ ? "raster-tiles" : "raster-items", true, binned_ ? "a group a tile" : "a lane a work item");
    note("resolve", value == "depth32+id32",
         value == "depth32+id32" ? "packed words become depth and ids" : "depth and ids are written as they are");
  }

  void wide() {
    if (choose("wide", device_.int64 ? "native" : "two-word") == "native" && !device_.int64)
      failUnsupported(fmt::format("wide=native: {} has no 64-bit integers (shaderInt64); set wide=two-word", device_.name));
  }

  /// Depth and id of each pixel.
  static std::uint64_t tileOwnedBytes(std::uint64_t tile) { return tile * tile * 8; }

  void shading() {
    const std::string shade = choose("shade", "none");
    plan_.shade = shade != "none";
    if (plan_.shade && plan_.resolved.get("commit") == "count")
      failUsage("shade=" + shade + ": commit=count keeps no ids to shade; set shade=none");
    if ((shade == "flat" || shade == "smooth") && scene_.positions.empty() && !scene_.triangles.empty())
      failUsage("shade=" + shade + ": the scene has clip-space positions only; set shade=id");
    if (shade == "smooth" && scene_.normals.size() != scene_.positions.size())
      failUsage("shade=smooth: the scene has no vertex normals; set shade=flat");
    note("shade", plan_.shade, plan_.shade ? "shade=" + shade : "no colours asked for (shade)");
    note("shade: normals", shade == "smooth", shade == "smooth" ? "they are interpolated" : "nothing interpolates them");
  }

  void attribute() {
    plan_.attribute = !scene_.attribute.empty();
    note("attribute", plan_.attribute,
         plan_.attribute ? "a raster of the values of " + scene_.attributeName : "no values asked for (attribute)");
    if (!plan_.attribute) return;
    if (scene_.attribute.size() != scene_.vertexCount())
      failUsage(fmt::format("attribute {}: {} values for {} vertices; one a vertex would be right", scene_.attributeName,
                            scene_.attribute.size(), scene_.vertexCount()));
    if (plan_.resolved.get("commit") == "count")
      failUsage(fmt::format("attribute {}: commit=count keeps no ids to interpolate by; leave commit unset",
                            scene_.attributeName));
  }

  const Scene& scene_;
  const Variant& asked_;
  const DeviceInfo& device_;
  bool full_;
  bool binned_ = true;
  Plan plan_;
};

}  // namespace

Plan makePlan(const Scene& scene, const Variant& variant, const DeviceInfo& device) {
  if (scene.width == 0 || scene.height == 0 || scene.width > kMaxExtent || scene.height > kMaxExtent)
    failUsage(
        fmt::format("size {}x{}: width and height go from 1 to {} pixels", scene.width, scene.height, kMaxExtent));
  return Planner(scene, variant, device).run();
}

}  // namespace tessera
