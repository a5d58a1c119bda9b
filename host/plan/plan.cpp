#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tessera/error.h>
#include <tessera/plan.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "host/plan/choice.h"
#include "host/plan/plan-scene.h"

namespace tessera {
namespace {

constexpr double kMostBoxes = 4294967296.0;      // that aabb-scan tests in a frame: some seconds on two cores
constexpr double kMostMaskBytes = 4294967296.0;  // that bitmask takes

class Planner {
 public:
  Planner(const Scene& scene, const Variant& asked, const DeviceInfo& device)
      : scene_(scene),
        asked_(asked),
        device_(device),
        choice_(asked, device),
        full_(asked.get("plan", "planned") == "full") {}

  Plan run() {
    choice_.take("plan", {"planned"});
    choice_.take("route", device_.routes);
    geometry();
    bins();
    raster();
    shading();
    attribute();
    plan_.resolved = choice_.resolved();
    return std::move(plan_);
  }

 private:
  void note(std::string pass, bool kept, std::string why) {
    plan_.entries.push_back({std::move(pass), kept, std::move(why)});
  }

  void geometry() {
    plan_.transform = !scene_.positions.empty();
    note("transform", plan_.transform,
         plan_.transform ? "positions are in object space" : "positions are given in clip space");
    note("project", true, "vertices are snapped once each");
    note("setup", true, "triangles become snapped, oriented pieces");

    const bool crosses = mayCross(scene_);
    plan_.clip = choice_.take("clip", {full_ || crosses ? "on" : "off"}) == "on";
    if (!plan_.clip && crosses)
      failUsage("clip=off: triangles of this scene may cross a clip plane; leave clip unset, or set clip=on");
    note("setup: clip", plan_.clip,
         crosses ? "a triangle may cross a clip plane" : "no triangle can cross a clip plane");

    const bool orthographic = isOrthographic(scene_);
    plan_.perspective =
        choice_.take("projection", {full_ || !orthographic ? "perspective" : "orthographic"}) == "perspective";
    if (!plan_.perspective && !orthographic)
      failUsage("projection=orthographic: w is not 1 at every vertex of this scene; leave projection unset");
    note("project: perspective division", plan_.perspective, orthographic ? "w is 1 at every vertex" : "w varies");

    choice_.take("sub-pixel", {"8"});
    const std::string cull = choice_.take("cull", {"none"});
    note("setup: cull by facing", cull != "none", cull == "none" ? "not asked for (cull)" : "cull=" + cull);
    choice_.take("fill", {"top-left"});
    const bool between = choice_.take("between-samples", {full_ ? "off" : "on"}) == "on";
    note("setup: drop between samples", between,
         between ? "a piece without a sample in its box need not be binned"
                 : "asked to go without (between-samples, plan)");
    const bool compact = choice_.take("compact", {"off"}) == "on";
    note("setup: compact", compact, compact ? "asked for (compact)" : "later passes skip empty slots");
    choice_.take("wide", {"native", "two-word"});
  }

  void bins() {
    const std::string commit = asked_.get("commit");
    const bool loose = !commit.empty() && commit != "count" && !axisValue("commit", commit).has(kWritesTiles);
    const std::string binning = loose ? choice_.take("binning", {"none", "exact", "queue"})
                                      : choice_.take("binning", {"exact", "queue", "none"});
    const bool binned = binning != "none", listed = binning == "exact" || binning == "queue";
    int largest = 64;
    while (largest > 8 && tileOwnedBytes(largest) > device_.maxGroupBytes) largest /= 2;
    const int tile = std::stoi(choice_.take("tile", {std::to_string(largest)}));
    const double tiles = std::ceil(double(scene_.width) / tile) * std::ceil(double(scene_.height) / tile);
    const double triangles = double(scene_.triangles.size());
    if (binning == "aabb-scan") checkScan(tiles, triangles);
    if (binning == "bitmask") checkMask(tiles, triangles);
    choice_.take("tile-test", {"edges", "box"});
    choice_.take(
        "capacity",
        {std::to_string(std::bit_ceil(static_cast<unsigned>(std::clamp(4 * triangles / tiles, 16.0, 32768.0))))});
    choice_.take("overflow", {"retry"});
    const std::string none = "no lists of pieces (binning=" + binning + ")";
    note("bin-count, scan", binning == "exact",
         binning == "exact" ? "bins are sized by counting first"
         : listed           ? "queues have a fixed capacity; only a retry counts and scans"
                            : none);
    note("bin-insert", listed || binning == "bitmask",
         listed || binning == "bitmask" ? "pieces go to the tiles that they touch" : none);
    plan_.binned = binned;
  }

  void checkScan(double tiles, double triangles) const {
    if (tiles * triangles > kMostBoxes)
      failUsage(
          fmt::format("binning=aabb-scan: {} tiles would go through {} boxes each, {:.1e} a frame; up to {:.1e} "
                      "would be taken: set a larger tile, or binning=exact",
                      tiles, triangles, tiles * triangles, kMostBoxes));
  }
  void checkMask(double tiles, double triangles) const {
    const double bytes = tiles * std::ceil(triangles / 32) * 4;
    if (bytes > kMostMaskBytes)
      failUsage(
          fmt::format("binning=bitmask: a bit for each of {} tiles and {} triangles takes {:.1f} GiB; up to "
                      "{:.0f} GiB would be taken: set a larger tile, or binning=exact",
                      tiles, triangles, bytes / 0x1p30, kMostMaskBytes / 0x1p30));
    if (bytes > double(device_.maxBufferBytes))
      failUnsupported(
          fmt::format("binning=bitmask: a bit for each of {} tiles and {} triangles takes {:.0f} MiB, the "
                      "largest buffer of {} holds {:.0f}; set a larger tile, or binning=exact",
                      tiles, triangles, bytes / 0x1p20, device_.name, double(device_.maxBufferBytes) / 0x1p20));
  }

  void raster() {
    const bool binned = plan_.binned;
    const AxisValue& commit =
        axisValue("commit", binned ? choice_.take("commit", {"tile-owned", "depth32+id32", "two-pass"})
                                   : choice_.take("commit", {"depth32+id32", "two-pass"}));
    const std::uint64_t groupMemory = tileOwnedBytes(std::stoul(choice_.resolved().get("tile")));
    if (commit.has(kWritesTiles) && groupMemory > device_.maxGroupBytes)
      failUnsupported(fmt::format("tile={}: {} takes {} bytes of group memory, {} has {}; set a smaller tile",
                                  choice_.resolved().get("tile"), commit.name, groupMemory, device_.name,
                                  device_.maxGroupBytes));
    if (commit.name == "depth16+id16" && scene_.triangles.size() > 65535)
      failUsage(
          fmt::format("commit=depth16+id16: 16 bits tell 65535 triangles apart, the scene has {}; set "
                      "commit=depth32+id32 or two-pass",
                      scene_.triangles.size()));
    plan_.clear = full_ || !commit.has(kWritesTiles);
    plan_.resolve = commit.has(kResolves);
    note("clear", plan_.clear,
         !commit.has(kWritesTiles) ? "atomics compare with what the frame holds"
         : full_                   ? "plan=full"
                                   : "each tile writes all of its own pixels");
    choice_.take("edge", {"int32"});
    choice_.take("size-class", {"off"});
    choice_.take("traversal", {"cell-reject"});
    choice_.take("step", {"direct"});
    choice_.take("interpolate", {"cell-plane"});
    choice_.take("counters", {"basic"});
    note(binned ? "raster-tiles" : "raster-items", true, binned ? "a group a tile" : "a lane a work item");
    note("resolve", plan_.resolve,
         plan_.resolve ? "packed words become depth and ids" : "depth and ids are written as they are");
  }

  /// Depth and id of each pixel.
  static std::uint64_t tileOwnedBytes(std::uint64_t tile) { return tile * tile * 8; }

  void shading() {
    const AxisValue& commit = axisValue("commit", choice_.resolved().get("commit"));
    const bool flatIsFit = !scene_.positions.empty() || scene_.triangles.empty();
    const std::string shade = choice_.take("shade", {"none", flatIsFit ? "flat" : "id"});
    plan_.payload = commit.has(kKeepsColours);
    plan_.shade = shade != "none" && !plan_.payload;
    if ((shade == "flat" || shade == "smooth") && !flatIsFit)
      failUsage("shade=" + shade + ": the scene has clip-space positions only; set shade=id");
    if (shade == "smooth" && scene_.normals.size() != scene_.positions.size())
      failUsage("shade=smooth: the scene has no vertex normals; set shade=flat");
    note("payload", plan_.payload,
         plan_.payload ? "the commit keeps a colour of each triangle" : "the commit keeps ids");
    note("shade", plan_.shade,
         plan_.shade     ? "shade=" + shade
         : plan_.payload ? "the commit keeps colours"
                         : "no colours asked for (shade)");
    note("normals", shade == "smooth", shade == "smooth" ? "they are interpolated" : "nothing interpolates them");
  }

  void attribute() {
    plan_.attribute = !scene_.attribute.empty();
    note("attribute", plan_.attribute,
         plan_.attribute ? "a raster of the values of " + scene_.attributeName : "no values asked for (attribute)");
    if (!plan_.attribute) return;
    if (scene_.attribute.size() != scene_.vertexCount())
      failUsage(fmt::format("attribute {}: {} values for {} vertices; one a vertex would be right",
                            scene_.attributeName, scene_.attribute.size(), scene_.vertexCount()));
    const std::string commit = choice_.resolved().get("commit");
    if (plan_.payload || commit == "count")
      failUsage(fmt::format("attribute {}: commit={} keeps no ids to interpolate by; leave commit unset",
                            scene_.attributeName, commit));
  }

  const Scene& scene_;
  const Variant& asked_;
  const DeviceInfo& device_;
  Choice choice_;
  bool full_;
  Plan plan_;
};

}  // namespace

Plan makePlan(const Scene& scene, const Variant& variant, const DeviceInfo& device) {
  if (scene.width == 0 || scene.height == 0 || scene.width > kMaxExtent || scene.height > kMaxExtent)
    failUsage(
        fmt::format("size {}x{}: width and height go from 1 to {} pixels", scene.width, scene.height, kMaxExtent));
  if (device.routes.empty()) failUsage(fmt::format("{}: it names no route for kernels; one would do", device.name));
  return Planner(scene, variant, device).run();
}

}  // namespace tessera
