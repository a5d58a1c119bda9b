#include "experiments/harness/axis-values.h"

#include <fmt/format.h>
#include <tessera/error.h>

#include <algorithm>

#include "datasets/text.h"
#include "host/support/suggest.h"

namespace tessera::harness {
namespace {

constexpr std::size_t kMaxValues = 1000;

const Axis& axisOf(const datasets::TomlTable& table, const toml::key& key) {
  const auto found = std::ranges::find(allAxes(), key.str(), &Axis::name);
  if (found == allAxes().end())
    table.refuseKey(key, fmt::format("no such axis; {}",
                                     support::whatThereIs(key.str(), support::namesOf(allAxes(), &Axis::name))));
  return *found;
}

/// A name, or a number as the text of it.
std::string textOf(const datasets::TomlTable& table, std::string_view key, const toml::node& node) {
  if (const auto number = node.value_exact<std::int64_t>()) return std::to_string(*number);
  if (const auto text = node.value_exact<std::string>()) return *text;
  table.refuse(key, node, "a value's name in quotes or a whole number would be right");
}

std::string checkedValue(const datasets::TomlTable& table, const Axis& axis, const toml::node& node, std::string text) {
  if (axis.values.empty()) {
    const auto number = datasets::toInteger(text);
    if (!number || *number < axis.least || *number > axis.most)
      table.refuse(
          axis.name, node,
          fmt::format("no value '{}'; a whole number from {} to {} would be right", text, axis.least, axis.most));
    return std::to_string(*number);
  }
  if (std::ranges::find(axis.values, text, &AxisValue::name) == axis.values.end())
    table.refuse(axis.name, node,
                 fmt::format("no value '{}'; {}", text,
                             support::whatThereIs(text, support::namesOf(axis.values, &AxisValue::name))));
  return text;
}

void addOnce(const datasets::TomlTable& table, std::string_view key, const toml::node& node,
             std::vector<std::string>& values, std::string value) {
  if (std::ranges::find(values, value) != values.end())
    table.refuse(key, node, fmt::format("'{}' is there twice; once would be right", value));
  values.push_back(std::move(value));
}

/// from, from * times, ... or from, from + step, ... up to and with `to`.
std::vector<std::int64_t> readRange(const datasets::TomlTable& table, std::string_view key, const toml::table& node) {
  constexpr std::int64_t kMost = 1'000'000'000;
  const datasets::TomlTable range(table.file(), node, fmt::format("the range of {}", key),
                                  {"from", "to", "times", "step"}, table.path() + std::string(key) + ".");
  range.need("from", "the first value would be right");
  range.need("to", "the last value would be right");
  const std::int64_t from = *range.whole("from", 0, kMost), to = *range.whole("to", 0, kMost);
  const auto times = range.whole("times", 2, kMost), step = range.whole("step", 1, kMost);
  if (times.has_value() == step.has_value())
    table.refuse(key, node, "either times, a factor, or step, a difference, would be right");
  if (from > to) table.refuse(key, node, fmt::format("no value from {} to {}; from <= to would be right", from, to));
  if (times && from == 0) table.refuse(key, node, "from 0 times anything is 0; step, or from 1, would be right");
  std::vector<std::int64_t> values;
  for (std::int64_t value = from; value <= to; value = times ? value * *times : value + *step) {
    if (values.size() == kMaxValues)
      table.refuse(key, node, fmt::format("more than {} values; a larger step or times would be right", kMaxValues));
    values.push_back(value);
  }
  return values;
}

}  // namespace

std::string readAxisValue(const datasets::TomlTable& table, const datasets::TomlTable::Entry& entry) {
  const Axis& axis = axisOf(table, entry.key);
  return checkedValue(table, axis, entry.node, textOf(table, axis.name, entry.node));
}

std::vector<std::string> readAxisValues(const datasets::TomlTable& table, const datasets::TomlTable::Entry& entry) {
  const Axis& axis = axisOf(table, entry.key);
  std::vector<std::string> values;
  if (const toml::table* const range = entry.node.as_table()) {
    for (const std::int64_t value : readRange(table, axis.name, *range))
      values.push_back(checkedValue(table, axis, entry.node, std::to_string(value)));
    return values;
  }
  const toml::array& list = *table.list(axis.name, "a list of values, or {from, to, times} or {from, to, step},");
  if (list.size() > kMaxValues)
    table.refuse(axis.name, list, fmt::format("more than {} values; fewer would be right", kMaxValues));
  for (const toml::node& node : list)
    addOnce(table, axis.name, node, values, checkedValue(table, axis, node, textOf(table, axis.name, node)));
  return values;
}

std::vector<std::string> readChosen(const datasets::TomlTable& table, const datasets::TomlTable::Entry& entry,
                                    const std::vector<SweptAxis>& swept) {
  const std::string key(entry.key.str());
  const auto axis = std::ranges::find(swept, key, &SweptAxis::axis);
  if (axis == swept.end())
    table.refuseKey(entry.key, swept.empty()
                                   ? "nothing varies; an axis under [axes] would be right"
                                   : fmt::format("does not vary in this sweep; {}",
                                                 support::whatThereIs(key, support::namesOf(swept, &SweptAxis::axis))));
  std::vector<std::string> values;
  const auto add = [&](const toml::node& node) {
    const std::string value = textOf(table, key, node);
    if (std::ranges::find(axis->values, value) == axis->values.end())
      table.refuse(key, node, fmt::format("no cell has '{}'; {}", value, support::whatThereIs(value, axis->values)));
    addOnce(table, key, node, values, value);
  };
  if (!entry.node.is_array()) return add(entry.node), values;
  for (const toml::node& node : *table.list(key, "a value, or a list of values,")) add(node);
  return values;
}

}  // namespace tessera::harness
