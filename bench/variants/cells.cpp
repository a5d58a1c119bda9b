#include "bench/variants/cells.h"

#include <tessera/error.h>

#include <algorithm>
#include <map>

namespace tessera::bench {
namespace {

std::vector<std::string> valuesOf(std::string_view name) {
  std::vector<std::string> names;
  for (const AxisValue& value : axis(name).values) names.push_back(value.name);
  return names;
}

class Maker {
 public:
  Maker(const Scene& scene, const DeviceInfo& device) : scene_(scene), device_(device) {}

  /// Number of the cell of this variant, which is that of another one where the planner makes the same of both.
  std::size_t add(const Variant& asked) {
    Cell cell;
    cell.asked = asked;
    try {
      cell.plan = makePlan(scene_, asked, device_);
    } catch (const Error& error) {
      cell.refused = error.what();
    }
    const Variant& known = cell.plan ? cell.plan->resolved : asked;
    cell.binning = known.get("binning", "-");
    cell.traversal = known.get("traversal", cells_.empty() ? "-" : cells_[0].traversal);
    cell.commit = known.get("commit", "-");
    const auto [place, isNew] = numbers_.emplace((cell.plan ? "" : "refused ") + known.text(), cells_.size());
    if (isNew) cells_.push_back(std::move(cell));
    return place->second;
  }

  Grid grid(std::string_view rowAxis, std::string_view columnAxis, const std::vector<std::string>& columns) {
    Grid grid{std::string(rowAxis), std::string(columnAxis), valuesOf(rowAxis), columns, {}};
    for (const std::string& row : grid.rows)
      for (const std::string& column : grid.columns) grid.cells.push_back(add({{rowAxis, row}, {columnAxis, column}}));
    return grid;
  }

  /// What the planner takes for commits that are set alone.
  std::vector<std::string> binningsOfCommits() const {
    std::vector<std::string> chosen;
    for (const std::string& commit : valuesOf("commit")) {
      try {
        const std::string binning = makePlan(scene_, {{"commit", commit}}, device_).resolved.get("binning");
        if (std::ranges::find(chosen, binning) == chosen.end()) chosen.push_back(binning);
      } catch (const Error&) {
        continue;  // its cells say why
      }
    }
    return chosen;
  }

  std::vector<Cell> cells() { return std::move(cells_); }

 private:
  const Scene& scene_;
  const DeviceInfo& device_;
  std::vector<Cell> cells_;
  std::map<std::string, std::size_t> numbers_;
};

}  // namespace

SceneCells makeCells(const Scene& scene, const DeviceInfo& device) {
  SceneCells all;
  all.triangles = scene.triangles.size();
  Maker maker(scene, device);
  maker.add({});
  all.grids.push_back(maker.grid("binning", "traversal", valuesOf("traversal")));
  all.grids.push_back(maker.grid("commit", "binning", maker.binningsOfCommits()));
  all.cells = maker.cells();
  return all;
}

Spread ratio(const Cell& cell) {
  constexpr double kScale = 1e6;  // spread() takes integers
  std::vector<std::uint64_t> scaled;
  for (std::size_t i = 0; i < cell.frames.size(); ++i)
    scaled.push_back(static_cast<std::uint64_t>(kScale * static_cast<double>(cell.frames[i].totalNs) /
                                                static_cast<double>(cell.defaults[i].totalNs)));
  const Spread s = spread(scaled);
  return {s.median / kScale, s.min / kScale, s.iqr / kScale};
}

}  // namespace tessera::bench
