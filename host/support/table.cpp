#include "host/support/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace tessera::support {
namespace {

bool looksNumeric(std::string_view cell) { return cell.find_first_not_of("0123456789.,-+%") == std::string_view::npos; }

}  // namespace

std::string table(const std::vector<std::vector<std::string>>& rows) {
  const std::size_t columns = rows.front().size();
  std::vector<std::size_t> widths(columns);
  std::vector<bool> numeric(columns, rows.size() > 1);
  for (std::size_t r = 0; r < rows.size(); ++r)
    for (std::size_t c = 0; c < columns; ++c) {
      widths[c] = std::max(widths[c], rows[r][c].size());
      if (r > 0 && !looksNumeric(rows[r][c])) numeric[c] = false;
    }
  std::string text;
  const auto addRow = [&](const std::vector<std::string>& cells) {
    std::string line;
    for (std::size_t c = 0; c < columns; ++c)
      line += numeric[c] ? fmt::format("{:>{}}  ", cells[c], widths[c]) : fmt::format("{:<{}}  ", cells[c], widths[c]);
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + '\n';
  };
  addRow(rows.front());
  std::vector<std::string> rule;
  for (const std::size_t width : widths) rule.push_back(std::string(width, '-'));
  addRow(rule);
  for (std::size_t r = 1; r < rows.size(); ++r) addRow(rows[r]);
  return text;
}

std::string grouped(std::uint64_t number) {
  std::string text = std::to_string(number);
  for (std::size_t i = text.size(); i > 3; i -= 3) text.insert(i - 3, 1, ',');
  return text;
}

std::string grouped(std::optional<std::uint64_t> number) { return number ? grouped(*number) : "-"; }

std::string milliseconds(double nanoseconds) {
  const double ms = nanoseconds * 1e-6;
  return fmt::format("{:.{}f}", ms, ms >= 100 ? 0 : ms >= 10 ? 1 : ms >= 1 ? 2 : 3);
}

std::string byteSize(std::uint64_t bytes) {
  if (bytes == ~0ull) return "any";
  if (bytes < 1u << 20) return fmt::format("{:.0f} KiB", static_cast<double>(bytes) / 1024.0);
  return bytes < 1u << 30 ? fmt::format("{:.0f} MiB", static_cast<double>(bytes) / 1048576.0)
                          : fmt::format("{:.1f} GiB", static_cast<double>(bytes) / 1073741824.0);
}

}  // namespace tessera::support
