#include "host/plan/needs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace tessera::plan {
namespace {

/// A stage that is kept, or left out, under its own name.
Need need(std::string stage, bool runs, std::string why) { return {runs, {{std::move(stage), runs, std::move(why)}}}; }

bool binsRun(const PlanFacts& facts, std::string_view stage) {
  return std::ranges::find(facts.binStages, stage) != facts.binStages.end();
}

}  // namespace

Need needClear(const PlanFacts& facts) {
  const bool owned = facts.settings.commit.writesTiles;
  return need("clear", facts.full || !owned,
              !owned       ? "atomics compare with what the frame holds"
              : facts.full ? "plan=full"
                           : "each tile writes all of its own pixels");
}

Need needTransform(const PlanFacts& facts) {
  const bool runs = !facts.scene.positions.empty();
  return need("transform", runs, runs ? "positions are in object space" : "positions are given in clip space");
}

/// Vertices are projected in any case: by the stage `transform` where it runs.
Need needProject(const PlanFacts& facts) {
  return {facts.scene.positions.empty(),
          {{"project", true, "vertices are snapped once each"},
           {"project: perspective division", facts.settings.perspective,
            facts.orthographic ? "w is 1 at every vertex" : "w varies"}}};
}

Need needSetup(const PlanFacts& facts) {
  const Settings& s = facts.settings;
  return {true,
          {{"setup", true, "triangles become snapped, oriented pieces"},
           {"setup: clip", s.clip,
            facts.crosses ? "a triangle may cross a clip plane" : "no triangle can cross a clip plane"},
           {"setup: cull by facing", s.cull != "none", s.cull == "none" ? "not asked for (cull)" : "cull=" + s.cull},
           {"setup: drop between samples", s.betweenSamples,
            s.betweenSamples ? "a piece without a sample in its box need not be binned"
                             : "asked to go without (between-samples, plan)"},
           {"setup: compact", s.compact, s.compact ? "asked for (compact)" : "later passes skip empty slots"}}};
}

Need needPayload(const PlanFacts& facts) {
  const bool runs = facts.settings.commit.keepsColours;
  return need("payload", runs, runs ? "the commit keeps a colour of each triangle" : "the commit keeps ids");
}

Need needBinCount(const PlanFacts& facts) {
  const bool runs = binsRun(facts, "bin-count");
  return {runs, {{"bin-count, scan", runs, runs ? "bins are sized by counting first" : facts.whyUncounted}}};
}
Need needScanBlocks(const PlanFacts& facts) { return {binsRun(facts, "scan-blocks"), {}}; }
Need needScanAdd(const PlanFacts& facts) { return {binsRun(facts, "scan-add"), {}}; }

Need needBinInsert(const PlanFacts& facts) {
  const bool runs = binsRun(facts, "bin-insert");
  return need(
      "bin-insert", runs,
      runs ? "pieces go to the tiles that they touch" : "no lists of pieces (binning=" + facts.settings.binning + ")");
}

Need needRasterTiles(const PlanFacts& facts) {
  return facts.byTiles ? need("raster-tiles", true, "a group a tile") : Need{false, {}};
}
Need needRasterItems(const PlanFacts& facts) {
  return facts.byTiles ? Need{false, {}} : need("raster-items", true, "a lane a work item");
}

Need needResolve(const PlanFacts& facts) {
  const bool runs = facts.settings.commit.resolves;
  return need("resolve", runs, runs ? "packed words become depth and ids" : "depth and ids are written as they are");
}

Need needShade(const PlanFacts& facts) {
  const bool packed = facts.settings.commit.keepsColours, smooth = facts.settings.shade == "smooth";
  const bool runs = facts.settings.shade != "none" && !packed;
  Need result = need("shade", runs,
                     runs     ? "shade=" + facts.settings.shade
                     : packed ? "the commit keeps colours"
                              : "no colours asked for (shade)");
  result.entries.push_back({"normals", smooth, smooth ? "they are interpolated" : "nothing interpolates them"});
  return result;
}

Need needAttribute(const PlanFacts& facts) {
  std::vector<std::string> names;
  for (const Stream* stream : interpolatedStreams(facts.scene)) names.push_back(stream->name);
  return need("attribute", !names.empty(),
              names.empty() ? "no values asked for (attribute)"
                            : fmt::format("a raster of the values of {}", fmt::join(names, ", ")));
}

}  // namespace tessera::plan
