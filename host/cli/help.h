// Help as text: what a command takes in two columns, wrapped to the terminal, and its own examples.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace tessera::cli {

/// Of the terminal that stdout is, or as $COLUMNS says, from 40 to 100; 100 elsewhere.
unsigned helpColumns();

/// Paragraphs, one a line of `text`, wrapped. A line that begins with a blank is left as it is: a command to be pasted.
std::string wrapped(std::string_view text, unsigned columns);
/// "  left   text", the text wrapped in a column of its own.
std::string twoColumns(std::string_view left, std::string_view text, unsigned columns);

/// One line an axis; one a generator.
std::string axesHelp(unsigned columns);
std::string inputHelp(unsigned columns);

/// Whether it is more than a flag.
bool takesValue(const CLI::Option& option);
/// "--size WxH", "-o, --output FILE", "INPUT".
std::string optionName(const CLI::Option& option);
/// What it is, with its default, and whether it has to be there.
std::string optionText(const CLI::Option& option);
/// Those that help shows, positional ones or the others.
std::vector<const CLI::Option*> optionsOf(const CLI::App& command, bool positional);
/// Commands that help shows.
std::vector<const CLI::App*> commandsOf(const CLI::App& app);
/// The command lines in its footer: those that begin with "  tessera ".
std::vector<std::string> examplesOf(const CLI::App& command);
bool takes(const CLI::App& command, const char* option);

/// What `tessera` alone says.
std::string shortHelp(const CLI::App& app);

/// The program's own way to lay out help: a command that takes --set is followed by the axes, one that takes INPUT by
/// the inputs.
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
};

}  // namespace tessera::cli
