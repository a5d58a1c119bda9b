// tessera variants: the axes of variation, for people, for programs and for the docs.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "host/cli/commands.h"
#include "host/variant.h"

namespace tessera::cli {
namespace {

struct VariantsOptions {
  bool json = false, markdown = false;
};

std::string rangeText(const Axis& axis) { return fmt::format("{} to {}", axis.least, axis.most); }

std::string axesJson() {
  auto json = nlohmann::ordered_json::array();
  for (const auto& axis : axes()) {
    nlohmann::ordered_json entry{{"name", axis.name},
                                 {"meaning", axis.meaning},
                                 {"source", axis.source},
                                 {"stages", axis.stages},
                                 {"unset", axis.unset}};
    if (axis.values.empty()) entry["range"] = {axis.least, axis.most};
    for (const auto& value : axis.values)
      entry["values"].push_back({{"name", value.name}, {"kind", kindName(value.kind)}, {"meaning", value.meaning}});
    json.push_back(entry);
  }
  return json.dump(2) + '\n';
}

std::string axesMarkdown() {
  std::string text = "| axis | meaning | values | when not set | source |\n|---|---|---|---|---|\n";
  for (const auto& axis : axes()) {
    std::vector<std::string> values;
    for (const auto& value : axis.values)
      values.push_back(fmt::format("`{}` ({}): {}", value.name, kindName(value.kind), value.meaning));
    text += fmt::format("| `{}` | {} | {} | {} | {} |\n", axis.name, axis.meaning,
                        values.empty() ? rangeText(axis) : fmt::format("{}", fmt::join(values, "<br>")), axis.unset,
                        axis.source);
  }
  return text;
}

std::string axesText() {
  std::string text;
  for (const auto& axis : axes()) {
    text += fmt::format("{}: {}\n", axis.name, axis.meaning);
    if (axis.values.empty()) text += fmt::format("  {}\n", rangeText(axis));
    for (const auto& value : axis.values)
      text += fmt::format("  {:<14} {:<14} {}\n", value.name, kindName(value.kind), value.meaning);
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
  return {command, [options] {
            fmt::print("{}", options->json ? axesJson() : options->markdown ? axesMarkdown() : axesText());
            return ExitCode::kDone;
          }};
}

}  // namespace tessera::cli
