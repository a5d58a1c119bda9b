// tessera variants: the axes of variation, for people, for programs and for the docs.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tessera/variant.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "host/axes/routes.h"
#include "host/cli/commands.h"
#include "host/devices/open.h"
#include "host/support/terminal.h"

namespace tessera::cli {
namespace {

struct VariantsOptions {
  bool json = false, markdown = false;
};

std::string rangeText(const Axis& axis) { return fmt::format("{} to {}", axis.least, axis.most); }

/// The devices that can run it.
std::string devicesText(const AxisValue& value) {
  std::vector<std::string> kinds, needs;
  for (const DeviceKind& kind : deviceKinds())
    if (axes::fulfils(kind.routes, value)) kinds.push_back(kind.title);
  if (value.needs.int64) needs.emplace_back("64-bit integers");
  if (value.needs.float64) needs.emplace_back("64-bit floats");
  if (value.needs.atomicMin64) needs.emplace_back("64-bit atomics");
  if (value.needs.groupAtomicMin64) needs.emplace_back("64-bit atomics in group memory");
  const std::string with = needs.empty() ? "" : fmt::format(" with {}", fmt::join(needs, " and "));
  return fmt::format("{}{}", fmt::join(kinds, ", "), with);
}

/// The rules about it: what it goes with.
std::vector<std::string> rulesText(const Axis& axis, const std::string& value) {
  std::vector<std::string> rules;
  for (const AxisRule& rule : axisRules()) {
    const bool named = value.empty() ? rule.values.empty() : std::ranges::count(rule.values, value) > 0;
    if (rule.axis == axis.name && named)
      rules.push_back(fmt::format("goes with {}={}: {}", rule.other, fmt::join(rule.only, " or "), rule.why));
  }
  return rules;
}

std::string limitsText(const Axis& axis, const AxisValue& value) {
  std::vector<std::string> all = rulesText(axis, value.name);
  if (!value.limits.empty()) all.insert(all.begin(), value.limits);
  return fmt::format("{}", fmt::join(all, "; "));
}

const std::string& sourceOf(const Axis& axis, const AxisValue& value) {
  return value.source.empty() ? axis.source : value.source;
}

std::string axesJson() {
  auto json = nlohmann::ordered_json::array();
  for (const auto& axis : allAxes()) {
    nlohmann::ordered_json entry{{"name", axis.name},
                                 {"meaning", axis.meaning},
                                 {"source", axis.source},
                                 {"stages", axis.stages},
                                 {"unset", axis.unset}};
    if (axis.values.empty()) entry["range"] = {axis.least, axis.most};
    if (const auto rules = rulesText(axis, ""); !rules.empty()) entry["limits"] = fmt::format("{}", fmt::join(rules, "; "));
    for (const auto& value : axis.values)
      entry["values"].push_back({{"name", value.name},
                                 {"kind", kindName(value.kind)},
                                 {"meaning", value.meaning},
                                 {"limits", limitsText(axis, value)},
                                 {"source", sourceOf(axis, value)},
                                 {"devices", devicesText(value)}});
    json.push_back(entry);
  }
  return json.dump(2) + '\n';
}

std::string axesMarkdown() {
  std::string text;
  for (const auto& axis : allAxes()) {
    text += fmt::format("## {}\n{}. When not set: {}.", axis.name, axis.meaning, axis.unset);
    if (!axis.stages.empty()) text += fmt::format(" Read by {}.", fmt::join(axis.stages, ", "));
    for (const std::string& rule : rulesText(axis, "")) text += fmt::format(" It {}.", rule);
    if (axis.values.empty()) {
      text += fmt::format(" An integer, {}.\n\n", rangeText(axis));
      continue;
    }
    text += "\n\n| value | kind | meaning | limits | devices | source |\n|---|---|---|---|---|---|\n";
    for (const auto& value : axis.values)
      text += fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", value.name, kindName(value.kind), value.meaning,
                          limitsText(axis, value), devicesText(value), sourceOf(axis, value));
    text += '\n';
  }
  text.pop_back();
  return text;
}

std::string axesText() {
  std::string text;
  for (const auto& axis : allAxes()) {
    text += fmt::format("{}: {}\n", axis.name, axis.meaning);
    if (axis.values.empty()) text += fmt::format("  {}\n", rangeText(axis));
    for (const auto& value : axis.values) {
      text += fmt::format("  {:<18} {:<14} {}\n", value.name, kindName(value.kind), value.meaning);
      if (devicesText(value) != devicesText({})) text += fmt::format("  {:<18} devices: {}\n", "", devicesText(value));
      if (const std::string limits = limitsText(axis, value); !limits.empty())
        text += fmt::format("  {:<18} limits: {}\n", "", limits);
      if (!value.source.empty()) text += fmt::format("  {:<18} source: {}\n", "", value.source);
    }
    for (const std::string& rule : rulesText(axis, "")) text += fmt::format("  {}\n", rule);
    text += fmt::format("  when not set: {}\n", axis.unset);
    if (!axis.source.empty()) text += fmt::format("  source: {}\n", axis.source);
    text += '\n';
  }
  return text +
         "image: changes what is right; implementation: may change no bit; approximate: its error is measured.\n";
}

}  // namespace

Command addVariants(CLI::App& app) {
  auto options = std::make_shared<VariantsOptions>();
  auto* const command = app.add_subcommand("variants", "list the axes of variation and their values");
  auto* const json = command->add_flag("--json", options->json, "print JSON");
  command->add_flag("--markdown", options->markdown, "print the table of the docs")->excludes(json);
  command->footer("Example:\n  tessera variants");
  return {command, [options] {
            support::say(stdout, "{}", options->json ? axesJson() : options->markdown ? axesMarkdown() : axesText());
            return ExitCode::kDone;
          }};
}

}  // namespace tessera::cli
