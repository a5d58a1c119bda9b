// Written as text: rectangles and words are all that it takes.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "bench/variants/cells.h"

namespace tessera::bench {
namespace {

constexpr int kCellWidth = 92, kCellHeight = 26, kLabel = 140, kTitle = 52, kGap = 28;
constexpr double kFar = 5;  // colours end at 2^-5 and 2^5

using Rgb = std::array<double, 3>;

/// Blue over white to orange, which colour-blind readers tell apart, and which differ in lightness from the middle.
Rgb colourOf(double ratio) {
  const double t = std::clamp(std::log2(ratio) / kFar, -1.0, 1.0);
  const Rgb middle{247, 247, 247}, end = t < 0 ? Rgb{33, 102, 172} : Rgb{179, 74, 6};
  Rgb colour;
  for (int c = 0; c < 3; ++c) colour[c] = middle[c] + std::abs(t) * (end[c] - middle[c]);
  return colour;
}

std::string box(double x, double y, double width, const Rgb& colour) {
  return fmt::format("<rect x='{:.0f}' y='{:.0f}' width='{:.0f}' height='{}' fill='rgb({:.0f},{:.0f},{:.0f})'/>\n", x,
                     y, width, kCellHeight - 2, colour[0], colour[1], colour[2]);
}

std::string word(double x, double y, std::string_view anchor, std::string_view text, std::string_view style = "") {
  return fmt::format("<text x='{:.0f}' y='{:.0f}' text-anchor='{}' {}>{}</text>\n", x, y, anchor, style, text);
}

std::string figure(double ratio) { return fmt::format("{:.{}f}", ratio, ratio < 9.995 ? 2 : ratio < 99.95 ? 1 : 0); }

std::string place(double x, double y, const Cell& cell) {
  const double middle = x + (kCellWidth - 2) / 2.0, line = y + 17;
  if (cell.frames.empty()) return box(x, y, kCellWidth - 2, {214, 214, 214}) + word(middle, line, "middle", "refused");
  const double times = ratio(cell).median;
  const bool dark = std::abs(std::log2(times)) > 0.6 * kFar;
  return box(x, y, kCellWidth - 2, colourOf(times)) +
         word(middle, line, "middle", figure(times), dark ? "fill='white'" : "");
}

int widthOf(const Grid& grid) { return kLabel + kCellWidth * static_cast<int>(grid.columns.size()) + kGap; }

std::string draw(const Grid& grid, const SceneCells& scene, double left, double top) {
  std::string out = word(left + kLabel - 8, top + kTitle - 8, "end", grid.rowAxis + " \\ " + grid.columnAxis);
  for (std::size_t c = 0; c < grid.columns.size(); ++c)
    out +=
        word(left + kLabel + kCellWidth * (static_cast<double>(c) + 0.5), top + kTitle - 8, "middle", grid.columns[c]);
  for (std::size_t r = 0; r < grid.rows.size(); ++r) {
    const double y = top + kTitle + kCellHeight * static_cast<double>(r);
    out += word(left + kLabel - 8, y + 17, "end", grid.rows[r]);
    for (std::size_t c = 0; c < grid.columns.size(); ++c)
      out += place(left + kLabel + kCellWidth * static_cast<double>(c), y,
                   scene.cells[grid.cells[r * grid.columns.size() + c]]);
  }
  return out;
}

std::string legend(double left, double top) {
  std::string out = word(left, top + 17, "start", "time / default's:");
  for (int i = -5; i <= 5; ++i) {
    const double x = left + kLabel + 56 * (i + 5);
    out += box(x, top, 54, colourOf(std::exp2(i)));
    out += word(x + 27, top + 17, "middle", i < 0 ? fmt::format("1/{}", 1 << -i) : std::to_string(1 << i),
                std::abs(i) > 3 ? "fill='white'" : "");
  }
  return out;
}

}  // namespace

std::string heatMap(const Report& report) {
  int width = kLabel + 56 * 11 + kGap, top = 8;
  std::string body = legend(16, top);
  top += kCellHeight + kGap / 2;
  for (const SceneCells& scene : report.scenes) {
    int left = 8;
    std::size_t rows = 0;
    body += word(16, top + 16, "start", scene.scene, "font-weight='bold'");
    for (const Grid& grid : scene.grids) {
      body += draw(grid, scene, left, top);
      left += widthOf(grid);
      rows = std::max(rows, grid.rows.size());
    }
    width = std::max(width, left);
    top += kTitle + kCellHeight * static_cast<int>(rows) + kGap / 2;
  }
  return fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {0} {1}' width='{0}' height='{1}' font-family='sans-serif' "
      "font-size='13'>\n<rect width='{0}' height='{1}' fill='white'/>\n{2}</svg>\n",
      width, top, body);
}

}  // namespace tessera::bench
