#include "datasets/toml-table.h"

#include <fmt/format.h>
#include <tessera/error.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "datasets/text.h"
#include "host/support/suggest.h"

namespace tessera::datasets {
namespace {

[[noreturn]] void failAt(const std::string& file, const toml::source_position& at, std::string_view wrong) {
  failUsage(fmt::format("{}:{}:{}: {}", file, at.line, at.column, wrong));
}

}  // namespace

toml::table parseToml(const std::string& file, std::string_view text) {
  // TOML itself takes no carriage return alone for a line's end.
  std::string lines(plainText(file, text));
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (lines[i] == '\r' && (i + 1 == lines.size() || lines[i + 1] != '\n')) lines[i] = '\n';
  try {
    return toml::parse(lines, file);
  } catch (const toml::parse_error& error) {
    failAt(file, error.source().begin, error.description());
  }
}

TomlTable::TomlTable(const std::string& file, const toml::table& table, std::string_view name,
                     std::initializer_list<std::string_view> keys, std::string path)
    : TomlTable(file, table, std::move(path)) {
  for (const auto& [key, node] : entries())
    if (std::ranges::find(keys, key.str()) == keys.end())
      fail(key.source(), fmt::format("{} has no key '{}'; {}", name, key.str(),
                                     support::whatThereIs(key.str(), {keys.begin(), keys.end()})));
}

const toml::node& TomlTable::need(std::string_view key, std::string_view what) const {
  const toml::node* const node = find(key);
  if (!node) fail(table_.source(), fmt::format("{}{} is missing: {}", path_, key, what));
  return *node;
}

std::vector<TomlTable::Entry> TomlTable::entries() const {
  std::vector<std::pair<const toml::key*, const toml::node*>> found;
  for (const auto& [key, node] : table_) found.emplace_back(&key, &node);
  std::ranges::sort(found, [](const auto& a, const auto& b) {
    const auto &at = a.first->source().begin, &other = b.first->source().begin;
    return std::pair(at.line, at.column) < std::pair(other.line, other.column);
  });
  std::vector<Entry> entries;
  for (const auto& [key, node] : found) entries.push_back({*key, *node});
  return entries;
}

void TomlTable::fail(const toml::source_region& where, std::string_view wrong) const {
  failAt(file_, where.begin, wrong);
}

void TomlTable::refuse(std::string_view key, const toml::node& node, std::string_view wrong) const {
  fail(node.source(), fmt::format("{}{}: {}", path_, key, wrong));
}

void TomlTable::refuseKey(const toml::key& key, std::string_view wrong) const {
  fail(key.source(), fmt::format("{}{}: {}", path_, key.str(), wrong));
}

std::optional<std::vector<double>> TomlTable::numbers(std::string_view key, std::size_t count) const {
  const toml::node* const node = find(key);
  if (!node) return std::nullopt;
  const toml::array* const array = node->as_array();
  std::vector<double> values;
  if (array)
    for (const toml::node& element : *array)
      if (element.is_number() && std::isfinite(*element.value<double>())) values.push_back(*element.value<double>());
  if (!array || array->size() != count || values.size() != count)
    refuse(key, *node, fmt::format("{} finite numbers in brackets would be right", count));
  return values;
}

std::optional<double> TomlTable::number(std::string_view key) const {
  const toml::node* const node = find(key);
  if (!node) return std::nullopt;
  if (!node->is_number() || !std::isfinite(*node->value<double>()))
    refuse(key, *node, "a finite number would be right");
  return node->value<double>();
}

std::optional<std::int64_t> TomlTable::whole(std::string_view key, std::int64_t least, std::int64_t most) const {
  const toml::node* const node = find(key);
  if (!node) return std::nullopt;
  const auto value = node->is_integer() ? node->value<std::int64_t>() : std::nullopt;
  if (!value || *value < least || *value > most)
    refuse(key, *node, fmt::format("a whole number from {} to {} would be right", least, most));
  return value;
}

std::optional<std::string> TomlTable::line(std::string_view key) const {
  const toml::node* const node = find(key);
  if (!node) return std::nullopt;
  const auto text = node->value<std::string>();
  if (!text || text->empty() || text->find_first_of("\r\n") != std::string::npos)
    refuse(key, *node, "a line of text in quotes would be right");
  return text;
}

const toml::array* TomlTable::list(std::string_view key, std::string_view what) const {
  const toml::node* const node = find(key);
  if (!node) return nullptr;
  if (!node->is_array() || node->as_array()->empty()) refuse(key, *node, fmt::format("{} would be right", what));
  return node->as_array();
}

}  // namespace tessera::datasets
