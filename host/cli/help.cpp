#include "host/cli/help.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/ioctl.h>
#include <tessera/input.h>
#include <tessera/variant.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <cstring>

#include "host/support/suggest.h"

namespace tessera::cli {
namespace {

constexpr unsigned kLeast = 40, kMost = 100, kColumn = 26;

std::string heading(const std::string& name) { return fmt::format("\n{}:\n", name); }

}  // namespace

unsigned helpColumns() {
  unsigned columns = 0;
  winsize window{};
  if (const char* const text = std::getenv("COLUMNS"))
    std::from_chars(text, text + std::strlen(text), columns);
  else if (isatty(STDOUT_FILENO) == 1 && ioctl(STDOUT_FILENO, TIOCGWINSZ, &window) == 0)
    columns = window.ws_col;
  return columns == 0 ? kMost : std::clamp(columns, kLeast, kMost);
}

std::string wrapped(std::string_view text, unsigned columns) {
  std::string result;
  while (!text.empty()) {
    std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    while (line.size() > columns && line[0] != ' ') {
      std::size_t blank = line.rfind(' ', columns);
      if (blank == line.npos) blank = std::min(line.find(' '), line.size());  // a word that is longer than a line
      result += fmt::format("{}\n", line.substr(0, blank));
      line.remove_prefix(std::min(blank + 1, line.size()));
    }
    result += fmt::format("{}\n", line);
  }
  return result;
}

std::string twoColumns(std::string_view left, std::string_view text, unsigned columns) {
  std::string result = fmt::format("  {}", left);
  const std::string lines = wrapped(text, std::max(columns, kColumn + 20) - kColumn);
  bool fits = result.size() + 2 <= kColumn;
  for (std::string_view rest = lines; !rest.empty();) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(line.size() + 1);
    if (fits)
      result += fmt::format("{:{}}{}\n", "", kColumn - result.size() + result.rfind('\n') + 1, line);
    else
      result += fmt::format("\n{:{}}{}\n", "", kColumn, line);
    fits = true;
  }
  return lines.empty() ? result + '\n' : result;
}

std::string axesHelp(unsigned columns) {
  std::string text = heading("AXIS=VALUE of --set ('tessera variants' says more)").substr(1);
  for (const Axis& axis : allAxes())
    text += twoColumns(axis.name,
                       axis.values.empty()
                           ? fmt::format("{} to {}", axis.least, axis.most)
                           : fmt::format("{}", fmt::join(support::namesOf(axis.values, &AxisValue::name), ", ")),
                       columns);
  return text;
}

std::string inputHelp(unsigned columns) {
  std::string text =
      wrapped("INPUT: a mesh (.obj, .off, .ply, .stl), a scene (.toml), a replay file (.replay), or", columns) +
      twoColumns("mesh:NAME", "an installed mesh, e.g. mesh:refined_elephant; 'tessera meshes' lists them", columns) +
      twoColumns("generate:NAME?KEY=VALUE&KEY=VALUE",
                 "a generated one, e.g. 'generate:icosphere?level=6', of:", columns);
  for (const GeneratorDoc& doc : generatorDocs())
    text += twoColumns("  " + doc.name, fmt::format("{}\n{}", doc.makes, doc.parameters), columns);
  return text;
}

bool takesValue(const CLI::Option& option) { return option.get_items_expected_max() != 0; }

std::string optionName(const CLI::Option& option) {
  if (option.get_positional()) return option.get_name(true, false);
  std::string name;
  for (const auto& part : option.get_snames()) name += fmt::format("{}-{}", name.empty() ? "" : ", ", part);
  for (const auto& part : option.get_lnames()) name += fmt::format("{}--{}", name.empty() ? "" : ", ", part);
  if (takesValue(option) && !option.get_type_name().empty()) name += " " + option.get_type_name();
  return name;
}

std::string optionText(const CLI::Option& option) {
  std::string text = option.get_description();
  if (takesValue(option) && !option.get_default_str().empty())
    text += fmt::format(" (default: {})", option.get_default_str());
  if (option.get_required() && !option.get_positional()) text += " (required)";
  return text;
}

std::vector<const CLI::Option*> optionsOf(const CLI::App& command, bool positional) {
  return command.get_options([positional](const CLI::Option* option) {
    return !option->get_group().empty() && option->get_positional() == positional;
  });
}

std::vector<const CLI::App*> commandsOf(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
}

std::vector<std::string> examplesOf(const CLI::App& command) {
  constexpr std::string_view kBegin = "  tessera ";
  std::vector<std::string> examples;
  const std::string footer = command.get_footer();
  for (std::string_view rest = footer; !rest.empty();) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    if (line.starts_with(kBegin)) examples.emplace_back(line.substr(2));
  }
  return examples;
}

std::string shortHelp(const CLI::App& app) {
  std::string text = "usage: tessera COMMAND ...\n\n";
  for (const CLI::App* command : commandsOf(app))
    text += twoColumns(command->get_name(), command->get_description(), kMost);
  text += "\nTry first:\n";
  for (const std::string& example : examplesOf(app)) text += fmt::format("  {}\n", example);
  return text + "'tessera help COMMAND' says more";
}

bool takes(const CLI::App& command, const char* option) { return command.get_option_no_throw(option) != nullptr; }

std::string HelpFormatter::make_help(const CLI::App* app, std::string name, CLI::AppFormatMode) const {
  const unsigned columns = helpColumns();
  const auto positional = optionsOf(*app, true), options = optionsOf(*app, false);
  const auto commands = commandsOf(*app);
  std::string text = wrapped(app->get_description(), columns), usage = "\nusage: " + name;
  if (!commands.empty()) usage += " COMMAND";
  for (const CLI::Option* option : positional)
    usage += option->get_required() ? " " + optionName(*option) : fmt::format(" [{}]", optionName(*option));
  text += usage + " [OPTIONS]\n";
  if (!positional.empty()) {
    text += "\n";
    for (const CLI::Option* option : positional) text += twoColumns(optionName(*option), optionText(*option), columns);
  }
  if (!commands.empty()) text += heading("Commands");
  for (const CLI::App* command : commands) text += twoColumns(command->get_name(), command->get_description(), columns);
  text += heading("Options");
  for (const CLI::Option* option : options) text += twoColumns(optionName(*option), optionText(*option), columns);
  if (const std::string footer = app->get_footer(); !footer.empty()) text += "\n" + wrapped(footer, columns);
  if (takes(*app, "INPUT")) text += "\n" + inputHelp(columns);
  if (takes(*app, "--set")) text += "\n" + axesHelp(columns);
  return text;
}

}  // namespace tessera::cli
