#include "host/plan/planner.h"

#include <fmt/format.h>
#include <tessera/error.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <memory>

#include "host/axes/routes.h"
#include "host/plan/choice.h"
#include "host/plan/needs.h"
#include "host/plan/plan-scene.h"
#include "host/plan/stages.h"

namespace tessera {
namespace {

class Planner {
 public:
  Planner(const Scene& scene, const Variant& asked, const DeviceInfo& device, const plan::BinsOf& binsOf)
      : scene_(scene),
        asked_(asked),
        device_(device),
        binsOf_(binsOf),
        choice_(asked, device),
        full_(asked.get("plan", "planned") == "full") {}

  Plan run() {
    choice_.take("plan", {"planned"});
    choice_.take("route", device_.routes);
    geometry();
    bins();
    raster();
    shading();
    return describe();
  }

 private:
  void geometry() {
    crosses_ = plan::mayCross(scene_);
    const std::string clip = choice_.take("clip", {full_ || crosses_ ? "on" : "off"});
    if (clip == "off" && crosses_)
      failUsage("clip=off: triangles of this scene may cross a clip plane; leave clip unset, or set clip=on");
    orthographic_ = plan::isOrthographic(scene_);
    const std::string projection =
        choice_.take("projection", {full_ || !orthographic_ ? "perspective" : "orthographic"});
    if (projection == "orthographic" && !orthographic_)
      failUsage("projection=orthographic: w is not 1 at every vertex of this scene; leave projection unset");
    choice_.take("sub-pixel", {"8"});
    choice_.take("cull", {"none"});
    choice_.take("fill", {"top-left"});
    choice_.take("between-samples", {full_ ? "off" : "on"});
    choice_.take("compact", {"off"});
    choice_.take("wide", {"native", "two-word"});
  }

  void bins() {
    const std::string commit = asked_.get("commit");
    const bool loose = !commit.empty() && !commitTraits(commit).wantsBins;
    bins_ = binsOf_(loose ? choice_.take("binning", {"none", "exact", "queue"})
                          : choice_.take("binning", {"exact", "queue", "none"}));
    choice_.take("size-class", {"off", "shape"});
    std::uint64_t largest = plan::kBlock;
    while (largest > 8 && tileBytes(largest) > device_.maxGroupBytes) largest /= 2;
    const double tile = std::stoi(choice_.take("tile", {std::to_string(largest)}));
    const plan::BinsLoad load{.tiles = std::ceil(scene_.width / tile) * std::ceil(scene_.height / tile),
                              .triangles = double(scene_.triangles.size())};
    bins_->check(load, device_);
    choice_.take("tile-test", {"edges", "box"});
    choice_.take("capacity", {std::to_string(std::bit_ceil(
                                 static_cast<unsigned>(std::clamp(4 * load.triangles / load.tiles, 16.0, 32768.0))))});
    choice_.take("overflow", {"retry"});
  }

  void raster() {
    const std::string commit = bins_->byTiles() ? choice_.take("commit", {"tile-owned", "depth32+id32", "two-pass"})
                                                : choice_.take("commit", {"depth32+id32", "two-pass"});
    const CommitTraits& traits = commitTraits(commit);
    const std::uint64_t groupMemory = tileBytes(choice_.resolved().number("tile"));
    if (traits.writesTiles && groupMemory > device_.maxGroupBytes)
      failUnsupported(fmt::format("tile={}: {} takes {} bytes of group memory, {} has {}; set {}",
                                  choice_.resolved().get("tile"), commit, groupMemory, device_.name,
                                  device_.maxGroupBytes,
                                  byShape() && tileBytes(8) > device_.maxGroupBytes ? "size-class=off" : "a smaller tile"));
    if (scene_.triangles.size() > traits.mostTriangles)
      failUsage(fmt::format(
          "commit={}: {:.0f} bits tell {} triangles apart, the scene has {}; set "
          "commit=depth32+id32 or two-pass",
          commit, std::log2(double(traits.mostTriangles) + 1), traits.mostTriangles, scene_.triangles.size()));
    choice_.take("edge", {"int32"});
    choice_.take("tile-word", {"split", "packed"});
    choice_.take("lane-width", {"native"});
    choice_.take("hidden", {"cell", "off"});
    choice_.take("order", {byShape() && oneThreadGroups() ? "nearest-first" : "as-binned"});
    choice_.take("traversal", {"cell-reject"});
    choice_.take("step", {"direct"});
    choice_.take("interpolate", {"cell-plane"});
    choice_.take("counters", {"basic"});
  }

  bool oneThreadGroups() const { return axes::routeNamed(choice_.resolved().get("route")).oneThreadGroups; }

  bool byShape() const { return choice_.resolved().is("size-class", "shape"); }

  /// Group memory of a tile that its group owns, at most: depth and id of each pixel; for size-class=shape a round of
  /// pieces and a list of samples, and the bounds of cells; for order=nearest-first the lists that are sorted.
  std::uint64_t tileBytes(std::uint64_t tile) const {
    const std::uint64_t round = 64 * 4 * (38 + std::max<std::uint64_t>(tile, 24)) + 1024;
    const bool sorts = asked_.is("order", "nearest-first") || (byShape() && oneThreadGroups());
    return tile * tile * 8 + (byShape() ? round : 0) + (sorts ? 7424 : 0);
  }

  void shading() {
    const bool flatIsFit = !scene_.positions.empty() || scene_.triangles.empty();
    const std::string shade = choice_.take("shade", {"none", flatIsFit ? "flat" : "id"});
    if ((shade == "flat" || shade == "smooth") && !flatIsFit)
      failUsage("shade=" + shade + ": the scene has clip-space positions only; set shade=id");
    const Stream* const normals = scene_.stream(kNormals);
    if (shade == "smooth" && (normals == nullptr || normals->values.size() != 3 * scene_.positions.size()))
      failUsage("shade=smooth: the scene has no vertex normals; set shade=flat");
    const std::string commit = choice_.resolved().get("commit");
    for (const Stream& stream : scene_.streams) checkStream(stream);
    for (const Stream* stream : interpolatedStreams(scene_)) {
      if (!commitTraits(commit).keepsIds)
        failUsage(fmt::format("attribute {}: commit={} keeps no ids to interpolate by; leave commit unset",
                              stream->name, commit));
    }
  }

  /// Kernels read what a stream promises: nothing else keeps them within its memory.
  void checkStream(const Stream& stream) const {
    const char* const what = stream.interpolated ? "attribute" : "stream";
    if (stream.components < 1 || stream.components > 4)
      failUsage(fmt::format("{} {}: {} floats a vertex; 1 to 4 would be right", what, stream.name, stream.components));
    const std::size_t right = scene_.vertexCount() * stream.components;
    if (stream.values.size() != right)
      failUsage(fmt::format("{} {}: {} values for {} vertices; {} would be right", what, stream.name,
                            stream.values.size(), scene_.vertexCount(),
                            stream.components == 1 ? "one a vertex" : std::to_string(right)));
    if (std::ranges::count(scene_.streams, stream.name, &Stream::name) > 1)
      failUsage(fmt::format("{} {}: two streams have this name", what, stream.name));
  }

  /// Which stages run, by the list of stages.
  Plan describe() {
    const plan::Settings settings = plan::settingsOf(choice_.resolved());
    const plan::PlanFacts facts{.scene = scene_,
                                .settings = settings,
                                .full = full_,
                                .crosses = crosses_,
                                .orthographic = orthographic_,
                                .byTiles = bins_->byTiles(),
                                .binStages = bins_->stages(settings),
                                .whyUncounted = bins_->whyUncounted(settings)};
    for (const std::string& stage : facts.binStages) plan::stageOf(stage);  // one that is not in the list would be lost
    Plan plan;
    for (const plan::Stage& stage : plan::stages()) {
      plan::Need need = stage.need(facts);
      if (need.runs) plan.stages.push_back(stage.name);
      std::ranges::move(need.entries, std::back_inserter(plan.entries));
    }
    for (const Stream& stream : scene_.streams) plan.streams.push_back(stream.name);
    plan.resolved = choice_.resolved();
    return plan;
  }

  const Scene& scene_;
  const Variant& asked_;
  const DeviceInfo& device_;
  const plan::BinsOf& binsOf_;
  plan::Choice choice_;
  bool full_, crosses_ = true, orthographic_ = false;
  std::unique_ptr<plan::BinsPlan> bins_;
};

}  // namespace

bool Plan::runs(std::string_view stage) const { return std::ranges::find(stages, stage) != stages.end(); }

namespace plan {

Plan planFrame(const Scene& scene, const Variant& variant, const DeviceInfo& device, const BinsOf& binsOf) {
  if (scene.width == 0 || scene.height == 0 || scene.width > kMaxExtent || scene.height > kMaxExtent)
    failUsage(
        fmt::format("size {}x{}: width and height go from 1 to {} pixels", scene.width, scene.height, kMaxExtent));
  if (device.routes.empty()) failUsage(fmt::format("{}: it names no route for kernels; one would do", device.name));
  return Planner(scene, variant, device, binsOf).run();
}

}  // namespace plan

}  // namespace tessera
