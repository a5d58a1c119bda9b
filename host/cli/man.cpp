// tessera man: the manual page, from the same commands, options, axes and inputs as the help.
#include "host/cli/man.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tessera/input.h>
#include <tessera/variant.h>

#include "host/build-info.h"
#include "host/cli/help.h"
#include "host/support/suggest.h"

namespace tessera::cli {
namespace {

/// Text that roff prints as it is.
std::string plain(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '\\')
      result += "\\e";
    else if (c == '-')
      result += "\\-";
    else if ((c == '.' || c == '\'') && (result.empty() || result.back() == '\n'))
      result += std::string("\\&") + c;
    else
      result += c;
  }
  return result;
}

std::string section(std::string_view name) { return fmt::format(".SH {}\n", name); }

std::string entry(std::string_view name, std::string_view text) {
  return fmt::format(".TP\n.B {}\n{}\n", plain(name), plain(text));
}

/// Paragraphs, and commands to be pasted as they stand.
std::string paragraphs(std::string_view text) {
  std::string result;
  bool verbatim = false;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    const bool command = line.starts_with("  ");
    if (command != verbatim) result += command ? ".PP\n.nf\n" : ".fi\n";
    verbatim = command;
    if (line.empty()) continue;
    result += command ? plain(line) + '\n' : ".PP\n" + plain(line) + '\n';
  }
  return verbatim ? result + ".fi\n" : result;
}

std::string commandText(const CLI::App& command) {
  std::string usage = "tessera " + command.get_name();
  for (const CLI::Option* option : optionsOf(command, true))
    usage += option->get_required() ? " " + optionName(*option) : fmt::format(" [{}]", optionName(*option));
  std::string text = fmt::format(".SS {}\n{}.\n", plain(usage), plain(command.get_description()));
  for (const bool positional : {true, false})
    for (const CLI::Option* option : optionsOf(command, positional))
      if (option != command.get_help_ptr()) text += entry(optionName(*option), optionText(*option));
  return text + paragraphs(command.get_footer());
}

}  // namespace

std::string manualPage(const CLI::App& app) {
  std::string text = fmt::format(".TH TESSERA 1 \"\" \"tessera {}\" \"User Commands\"\n", TESSERA_VERSION);
  text += section("NAME") + "tessera \\- rasterise triangles in compute shaders\n";
  text += section("SYNOPSIS") + ".B tessera\n.I COMMAND\n[\\fIOPTIONS\\fR]\n";
  text += section("DESCRIPTION") + plain(app.get_description()) + '\n' + paragraphs(app.get_footer());
  text += section("COMMANDS");
  for (const CLI::App* command : commandsOf(app)) text += commandText(*command);
  text += section("INPUTS") +
          paragraphs(
              "INPUT is a mesh (.obj, .off, .ply, .stl), a scene (.toml), a replay file (.replay), or one of these:");
  text += entry("mesh:NAME", "an installed mesh, such as mesh:refined_elephant; 'tessera meshes' lists them");
  for (const GeneratorDoc& doc : generatorDocs())
    text += entry(fmt::format("generate:{}?KEY=VALUE&KEY=VALUE", doc.name), doc.makes + ". " + doc.parameters);
  text += section("AXES") + paragraphs("What --set takes. An axis that is not set is the plan's choice.");
  for (const Axis& axis : allAxes())
    text += entry(axis.name,
                  fmt::format("{}: {}. When not set: {}.", axis.meaning,
                              axis.values.empty()
                                  ? fmt::format("{} to {}", axis.least, axis.most)
                                  : fmt::format("{}", fmt::join(support::namesOf(axis.values, &AxisValue::name), ", ")),
                              axis.unset));
  text += section("ENVIRONMENT");
  text += entry("TESSERA_CACHE",
                "the folder of compiled kernels and unpacked meshes; else tessera in $XDG_CACHE_HOME or ~/.cache");
  text += entry("SLANGC", "the Slang compiler; else the first in PATH that will do, else the one that ./dev fetched");
  text += entry("TESSERA_SLANG_SOURCES", "the folder of the kernels' sources");
  text += entry("TESSERA_PYTHON", "a Python 3.11 that makes reports");
  text += entry("COLUMNS", "the width of help, at most 100");
  return text;
}

}  // namespace tessera::cli
