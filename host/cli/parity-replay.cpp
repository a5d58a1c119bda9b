#include "host/cli/parity-replay.h"

#include <tessera/error.h>
#include <tessera/image.h>
#include <tessera/input.h>
#include <tessera/plan.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "host/measure/parity-oracle.h"
#include "host/plan/stages.h"
#include "host/support/files.h"
#include "host/support/progress.h"

namespace tessera::cli {
namespace {

constexpr double kSeconds = 20;

Scene replayOf(const Scene& scene) {
  const support::TemporaryFolder folder(support::temporaryRoot(), "tessera-replay");
  const std::filesystem::path file = folder.path() / "scene.replay";
  writeReplay(file, scene);
  return readReplay(file);
}

Variant withoutShade(const Variant& variant) {
  Variant rest;
  for (const auto& [name, value] : variant.values())
    if (name != "shade") rest.set(name, value);
  return rest;
}

/// Renders scenes with the users' kernels that run on replays.
class Renderer {
 public:
  Renderer(const Side& side, const Scene& replay, const KernelFiles& files)
      : variant_(withoutShade(side.variant)),
        kernels_(KernelCache::Options{.files = filesOfReplay(replay, side, files)}),
        rasterizer_(side.device, kernels_) {}
  const Variant& variant() const { return variant_; }
  Framebuffer image(const Scene& scene) { return rasterizer_.render(scene, variant_).image; }

 private:
  Variant variant_;
  KernelCache kernels_;
  Rasterizer rasterizer_;
};

struct Pair {
  Framebuffer right, found;
};

/// Ids at the pixels that differ: of the first one, and of all.
std::vector<std::vector<std::uint32_t>> suspectsOf(const Pair& pair) {
  std::vector<std::set<std::uint32_t>> sets(2);
  const Framebuffer &a = pair.right, &b = pair.found;
  for (std::size_t i = 0; i < a.ids.size() && i < b.ids.size(); ++i) {
    const bool depth = i < a.depth.size() && i < b.depth.size() && a.depth[i] != b.depth[i];
    if (a.ids[i] == b.ids[i] && !depth) continue;
    for (auto& set : sets) {
      if (&set == &sets[0] && !sets[1].empty()) continue;
      for (const std::uint32_t id : {a.ids[i], b.ids[i]}) set.insert(id);
    }
  }
  std::vector<std::vector<std::uint32_t>> suspects;
  for (auto& set : sets) {
    std::vector<std::uint32_t> ids(set.begin(), set.end());
    std::erase_if(ids, [](std::uint32_t id) { return id == kNoTriangle || id == kUnknownTriangle; });
    if (!ids.empty()) suspects.push_back(std::move(ids));
  }
  return suspects;
}

}  // namespace

KernelFiles filesOfReplay(const Scene& replay, const Side& side, const KernelFiles& files) {
  const std::vector<std::string> runs = makePlan(replay, withoutShade(side.variant), side.device.info()).stages;
  KernelFiles kept;
  for (const auto& [stage, file] : files)
    if (std::ranges::find(runs, stage) != runs.end()) kept.emplace(stage, file);
  return kept;
}

std::optional<Reduced> reduceToReplay(const Scene& scene, const Side& different, const Side* first,
                                      const KernelFiles& files) {
  const Scene replay = replayOf(scene);
  Renderer here(different, replay, files);
  std::optional<Renderer> there;
  if (first != nullptr) there.emplace(*first, replay, files);
  const auto bothOf = [&](const Scene& some) {
    Framebuffer found = here.image(some);
    Framebuffer right = there ? there->image(some) : measure::Oracle(some, here.variant()).expected(found);
    return Pair{std::move(right), std::move(found)};
  };
  const auto differs = [&](const Scene& some) {
    try {
      const Pair pair = bothOf(some);
      return !compare(pair.right, pair.found).equal();
    } catch (const Error&) {
      return false;  // another fault than the one that is looked for
    }
  };
  try {
    const Pair whole = bothOf(replay);
    if (compare(whole.right, whole.found).equal()) return {};
    const std::size_t all = replay.triangles.size();
    support::Progress progress("triangles left out", all);
    return reduceTriangles(replay, suspectsOf(whole), differs, kSeconds,
                           [&](std::size_t left) { progress.at(all - left); });
  } catch (const Error& error) {
    if (error.code() == ExitCode::kUsage) throw;
    return {};
  }
}

}  // namespace tessera::cli
