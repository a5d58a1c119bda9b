#include "host/cli/parity-witness.h"

#include <fmt/format.h>
#include <tessera/framebuffer.h>

#include <algorithm>
#include <array>
#include <vector>

#include "host/measure/parity-oracle.h"

namespace tessera::cli {
namespace {

/// What the contract says of the image, and the route, stays as it is.
bool stays(const std::string& name) { return name == "route" || axis(name).kind() == AxisKind::kImage; }

Variant without(const Variant& variant, const std::string& left) {
  Variant rest;
  for (const auto& [name, value] : variant.values())
    if (name != left) rest.set(name, value);
  return rest;
}

/// Pieces in an order of their own; empty slots, whose id is the last word, are none.
void sortPieces(StageOutput& output) {
  std::vector<std::vector<std::uint32_t>> pieces;
  for (auto at = output.values.begin(); at != output.values.end(); at += static_cast<std::ptrdiff_t>(output.words))
    if (*(at + static_cast<std::ptrdiff_t>(output.words) - 1) != kNoTriangle)
      pieces.emplace_back(at, at + static_cast<std::ptrdiff_t>(output.words));
  // By id first, so that the first piece that differs is that of one triangle.
  std::ranges::sort(pieces,
                    [](const auto& a, const auto& b) { return std::pair(a.back(), a) < std::pair(b.back(), b); });
  output.values.clear();
  for (const auto& piece : pieces) output.values.insert(output.values.end(), piece.begin(), piece.end());
}

Frame comparable(const Frame& frame, bool sameSlots, bool sameBins) {
  Frame kept;
  for (StageOutput output : frame.stages) {
    if (output.stage == "bin" && !sameBins) continue;
    if (output.stage == "setup" && !sameSlots) sortPieces(output);
    kept.stages.push_back(std::move(output));
  }
  return kept;
}

}  // namespace

std::vector<Witness> witnesses(const Variant& variant, bool hasFiles) {
  std::vector<Witness> list;
  if (hasFiles) list.push_back({"without --kernel", variant, false});
  std::vector<std::string> may;
  for (const auto& [name, value] : variant.values())
    if (!stays(name)) may.push_back(name);
  if (may.size() > 1)
    for (const std::string& name : may)
      list.push_back({fmt::format("without --set {}={}", name, variant.get(name)), without(variant, name), hasFiles});
  Variant plain;
  for (const auto& [name, value] : variant.values())
    if (stays(name)) plain.set(name, value);
  if (may.size() == 1)
    list.push_back({fmt::format("without --set {}={}", may[0], variant.get(may[0])), plain, hasFiles});
  if (!may.empty()) list.push_back({"with none of these settings", plain, false});
  return list;
}

std::string firstStageAgainst(const Frame& good, const Variant& goodVariant, const std::string& goodName,
                              const Frame& frame, const Variant& variant, const std::string& name) {
  const auto same = [&](const auto& names) {
    return std::ranges::all_of(names, [&](const char* axis) { return goodVariant.get(axis) == variant.get(axis); });
  };
  const bool slots = same(std::array{"compact", "between-samples", "cull"});
  const bool bins = slots && same(std::array{"binning", "tile", "tile-test", "capacity", "size-class", "overflow"});
  return measure::firstStage(comparable(good, slots, bins), goodName, comparable(frame, slots, bins), name);
}

}  // namespace tessera::cli
