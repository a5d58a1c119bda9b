#include "experiments/harness/report-keys.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tessera/counters.h>

#include <algorithm>
#include <array>

#include "datasets/text.h"
#include "experiments/harness/axis-values.h"
#include "host/support/suggest.h"

namespace tessera::harness {
namespace {

using Names = std::vector<std::string>;

/// Of a row's `error` and `truth_error`, as host/measure/row.cpp writes them.
const Names kErrorFields{"pixels",
                         "coverage_mismatch",
                         "id_mismatch",
                         "depth_mismatch",
                         "depth_max_ulp",
                         "depth_max_abs",
                         "hit_count_mismatch",
                         "hit_count_not_one",
                         "attribute_mismatch",
                         "colour_mismatch",
                         "winner_mismatch",
                         "attribute_max",
                         "attribute_rms",
                         "psnr"};
/// Less is better, which psnr is not, and the raster's size is no error.
const Names kPlottedErrors(kErrorFields.begin() + 1, kErrorFields.end() - 1);
const Names kStatuses{"ok", "overflow", "unsupported", "timeout", "error"};

std::string oneOf(const datasets::TomlTable& table, std::string_view key, const toml::node& node, const Names& names) {
  const auto text = node.value_exact<std::string>();
  if (!text)
    table.refuse(key, node, fmt::format("a name in quotes would be right; {}", support::whatThereIs("", names)));
  if (std::ranges::find(names, *text) == names.end())
    table.refuse(key, node, fmt::format("no '{}'; {}", *text, support::whatThereIs(*text, names)));
  return *text;
}

void listOf(const datasets::TomlTable& table, std::string_view key, const Names& names) {
  const toml::array* const list = table.list(key, "a list of names");
  if (!list) return;
  Names seen;
  for (const toml::node& node : *list) {
    const std::string name = oneOf(table, key, node, names);
    if (std::ranges::find(seen, name) != seen.end())
      table.refuse(key, node, fmt::format("'{}' is there twice; once would be right", name));
    seen.push_back(name);
  }
}

void oneOrMore(const datasets::TomlTable& table, std::string_view key, const Names& names) {
  const toml::node* const node = table.find(key);
  if (node && !node->is_array())
    oneOf(table, key, *node, names);
  else
    listOf(table, key, names);
}

/// A number, or one after a comparison and a blank.
void checkBound(const datasets::TomlTable& table, const datasets::TomlTable::Entry& entry) {
  if (entry.node.is_number()) return;
  const std::string text = entry.node.value_exact<std::string>().value_or("");
  const std::size_t blank = std::min(text.find(' '), text.size() - 1);
  const auto comparisons = {"<", ">", "<=", ">="};
  if (text.empty() || std::ranges::find(comparisons, text.substr(0, blank)) == comparisons.end() ||
      !datasets::toDouble(text.substr(blank + 1)))
    table.refuse(entry.key.str(), entry.node,
                 "a number, or a comparison such as \"> 0\" or \"<= 1e-3\", would be right");
}

void checkBounds(const datasets::TomlTable& expect, std::string_view key, const Names& fields) {
  const toml::node* const node = expect.find(key);
  if (!node) return;
  if (!node->is_table()) expect.refuse(key, *node, fmt::format("{}.FIELD = a number or a bound would be right", key));
  const datasets::TomlTable bounds(expect.file(), *node->as_table(), fmt::format("{}{}.", expect.path(), key));
  for (const datasets::TomlTable::Entry& entry : bounds.entries()) {
    if (std::ranges::find(fields, entry.key.str()) == fields.end())
      bounds.refuseKey(entry.key, fmt::format("no such field; {}", support::whatThereIs(entry.key.str(), fields)));
    checkBound(bounds, entry);
  }
}

}  // namespace

void checkPlot(const datasets::TomlTable& plot, const Sweep& sweep) {
  Names curves;
  for (const SweptAxis& axis : sweptAxes(sweep)) curves.push_back(axis.axis);
  for (const char* const other : {"scene", "size", "device", "threads"}) curves.emplace_back(other);
  Names places = curves;
  if (std::ranges::all_of(sweep.scenes, [](const SweepScene& scene) { return scene.x.has_value(); }))
    places.emplace_back("x");
  listOf(plot, "curve", curves);
  listOf(plot, "against", places);
  plot.line("x-label");
  if (const toml::array* const pairs = plot.list("heat", "a list of pairs of axes"))
    for (const toml::node& pair : *pairs) {
      const toml::array* const both = pair.as_array();
      if (!both || both->size() != 2) plot.refuse("heat", pair, "two axes in brackets would be right");
      if (oneOf(plot, "heat", (*both)[0], places) == oneOf(plot, "heat", (*both)[1], places))
        plot.refuse("heat", pair, "an axis against itself; two different ones would be right");
    }
  if (const toml::node* const error = plot.find("error")) oneOf(plot, "error", *error, kPlottedErrors);
  plot.line("figure");
}

void checkExpectation(const datasets::TomlTable& expect, const Sweep& sweep) {
  if (const toml::node* const node = expect.find("where")) {
    if (!node->is_table()) expect.refuse("where", *node, "{axis = value} would be right");
    const datasets::TomlTable where(expect.file(), *node->as_table(), expect.path() + "where.");
    const auto swept = sweptAxes(sweep);
    for (const datasets::TomlTable::Entry& entry : where.entries()) readChosen(where, entry, swept);
  }
  Names scenes, counters;
  for (const SweepScene& scene : sweep.scenes) scenes.push_back(scene.name);
  for (const CounterDoc& doc : counterDocs()) counters.push_back(doc.name);
  oneOrMore(expect, "scene", scenes);
  oneOrMore(expect, "status", kStatuses);
  checkBounds(expect, "error", kErrorFields);
  if (const toml::node* const node = expect.find("truth_error"); node && sweep.truth.values().empty())
    expect.refuse("truth_error", *node, "there is no [truth] to measure it from");
  checkBounds(expect, "truth_error", kErrorFields);
  checkBounds(expect, "counters", counters);
  const auto says = {"status", "error", "truth_error", "counters"};
  if (std::ranges::none_of(says, [&](const char* key) { return expect.has(key); }))
    expect.fail(expect.table().source(),
                fmt::format("expect: says nothing of a row; {} would be right", fmt::join(says, ", ")));
}

}  // namespace tessera::harness
