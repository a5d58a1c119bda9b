// What is measured: cells, each a choice of binning, traversal and commit, and the tables that they stand in.
#pragma once

#include <tessera/rasterizer.h>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/measure/row.h"

namespace tessera::bench {

struct Cell {
  Variant asked;
  std::string binning, traversal, commit;  ///< of the plan; as asked for where it is refused
  std::optional<Plan> plan;
  std::string refused;                       ///< one line, where there is no plan
  std::vector<FrameTimes> frames, defaults;  ///< one a round; the default's frame that ran beside it
  std::vector<unsigned> rounds;              ///< their numbers
  bool slow = false;                         ///< one frame took longer than the bound: measured once
  Counters counters;                         ///< of one frame with counters=work, which is not timed
  double spentS = 0;                         ///< seconds of the wall clock, the defaults' frames included
};

/// Rows and columns of values of two axes; each place holds the number of a cell.
struct Grid {
  std::string rowAxis, columnAxis;
  std::vector<std::string> rows, columns;
  std::vector<std::size_t> cells;  ///< row by row
};

struct SceneCells {
  std::string scene;
  std::size_t triangles = 0;
  std::vector<Cell> cells;  ///< the first is the default
  std::vector<Grid> grids;  ///< binning x traversal; commit x the binnings that the planner chooses for commits
};

/// All of them for a scene, from axes(): what is planned alike is there once, what is refused is there with the reason.
SceneCells makeCells(const Scene& scene, const DeviceInfo& device);

/// Median and interquartile range over the rounds of a cell's time over that of the default beside it.
Spread ratio(const Cell& cell);

struct Limits {
  unsigned rounds = 7;
  double budgetS = 5;  ///< a cell and scene: no further round once it is spent
  double slowS = 5;    ///< a cell whose first frame takes longer is measured once
};

struct Report {
  std::vector<std::pair<std::string, std::string>> provenance;
  std::uint32_t size = 0;  ///< width and height, pixels
  Limits limits;
  std::vector<SceneCells> scenes;
};

/// Tables for people, of one scene.
std::string text(const SceneCells& scene, const Limits& limits);
/// JSON Lines: the run, then medians, spreads and counters, a line a cell; with `raw`, a line a cell and round, too.
std::string jsonLines(const Report& report, bool raw);
/// An SVG picture of the grids: colours are the ratios to the default, on a logarithmic scale.
std::string heatMap(const Report& report);

}  // namespace tessera::bench
