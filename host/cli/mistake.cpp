#include "host/cli/mistake.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tessera/error.h>
#include <tessera/variant.h>

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <iterator>
#include <sstream>
#include <vector>

#include "host/cli/help.h"
#include "host/support/suggest.h"

namespace tessera::cli {
namespace {

/// Words of others for what a command does, and for what an option says.
const std::vector<std::pair<std::string, std::string>> kOtherWords{
    {"draw", "render"},         {"run", "render"},        {"time", "render"},           {"bench", "render"},
    {"benchmark", "render"},    {"view", "render"},       {"diff", "compare"},          {"check", "parity"},
    {"test", "parity"},         {"verify", "parity"},     {"axes", "variants"},         {"list", "devices"},
    {"mesh", "meshes"},         {"inputs", "meshes"},     {"info", "devices"},          {"gpus", "devices"},
    {"compile", "kernels"},     {"emit", "kernels"},      {"experiment", "sweep"},      {"plot", "report"},
    {"complete", "completion"}, {"--width", "--size"},    {"--height", "--size"},       {"--resolution", "--size"},
    {"--res", "--size"},        {"--gpu", "--device"},    {"--cpu", "--device"},        {"--backend", "--device"},
    {"--axis", "--set"},        {"--frames", "--repeat"}, {"--iterations", "--repeat"}, {"--runs", "--repeat"},
    {"--jobs", "--threads"},    {"-j", "--threads"},      {"-n", "--repeat"},           {"-t", "--threads"},
    {"-s", "--size"},           {"-d", "--device"},       {"--silent", "--quiet"},      {"--field", "--attribute"},
    {"--value", "--attribute"}};

std::string meant(const std::string& typed, const std::vector<std::string>& known) {
  for (const auto& [other, ours] : kOtherWords)
    if (other == typed && std::ranges::find(known, ours) != known.end()) return ours;
  return support::nearest(typed, known);
}

std::vector<std::string> commandNames(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : commandsOf(app)) names.push_back(command->get_name());
  return names;
}

std::string noCommand(const CLI::App& app, const std::string& typed) {
  const bool input = typed.find_first_of(":./") != std::string::npos;
  if (input) return fmt::format("{}: no command; did you mean 'tessera render {}'?", typed, typed);
  const auto names = commandNames(app);
  const std::string close = meant(typed, names);
  return fmt::format("no command '{}'; {}", typed,
                     close.empty() ? support::whatThereIs(typed, names)
                                   : fmt::format("did you mean {}? 'tessera help' lists them", close));
}

std::string noOption(const CLI::App& command, const std::string& typed, const std::string& place) {
  const std::string name = typed.substr(0, typed.find('='));
  std::vector<std::string> names;
  for (const CLI::Option* option : optionsOf(command, false)) {
    for (const auto& part : option->get_lnames()) names.push_back("--" + part);
    for (const auto& part : option->get_snames()) names.push_back("-" + part);
  }
  std::string close = meant(name, names);
  const std::vector<std::string> axisNames = support::namesOf(allAxes(), &Axis::name);
  const auto axis = std::ranges::find(axisNames, name.substr(std::min(name.find_first_not_of('-'), name.size())));
  if (axis != axisNames.end() && takes(command, "--set")) close = fmt::format("--set {}=VALUE", *axis);
  return fmt::format("{}no option {}; {}'{} --help' lists them", place, name,
                     close.empty() ? "" : fmt::format("did you mean {}? ", close),
                     command.get_parent() ? "tessera " + command.get_name() : "tessera");
}

}  // namespace

const CLI::App& commandNamed(const CLI::App& app, const std::string& name) {
  const auto all = commandsOf(app);
  const auto found = std::ranges::find_if(all, [&](const CLI::App* command) { return command->get_name() == name; });
  if (found == all.end()) failUsage(noCommand(app, name));
  return **found;
}

namespace {

/// "usage" at the end of a message, where help is.
std::string usageHint(const CLI::App& command) {
  return fmt::format("; '{} --help' shows the usage",
                     command.get_parent() ? "tessera " + command.get_name() : "tessera");
}

/// What a value has to be: the name that help has for it.
std::string kindOf(const CLI::Option& option) {
  return option.get_type_name().empty() ? "a value" : option.get_type_name();
}

const CLI::Option* optionOf(const CLI::App& command, const std::string& typed) {
  return typed.size() > 1 && typed[0] == '-' ? command.get_option_no_throw(typed.substr(0, typed.find('='))) : nullptr;
}

/// Where `=` is not followed by a value, or stands where none may: CLI11 takes the next word instead, or the sign for a
/// part of the value. "" where each is right.
std::string equalsMistake(const CLI::App& command, const std::vector<std::string>& words, const std::string& place) {
  for (const std::string& word : words) {
    if (word == "--") break;
    const std::size_t equals = word.find('=');
    const CLI::Option* const option = equals == word.npos ? nullptr : optionOf(command, word);
    if (option == nullptr) continue;
    const std::string name = word.substr(0, equals), value = word.substr(equals + 1);
    if (!takesValue(*option)) return fmt::format("{}{}: it takes no value; {} alone would be right", place, word, name);
    if (value.empty())
      return fmt::format("{}{}: nothing follows the =; {} would be right", place, word, kindOf(*option));
    if (!word.starts_with("--"))
      return fmt::format("{}{}: an option of one letter takes its value without =; {} {} would be right", place, word,
                         name, value);
  }
  return "";
}

/// Values that were taken and cannot be meant: empty ones, and the command's own options where a value is missing.
std::string valueMistake(const CLI::App& command, const std::string& place) {
  for (const CLI::Option* option : command.get_options()) {
    if (!takesValue(*option)) continue;
    for (const std::string& value : option->results()) {
      if (value.empty())
        return fmt::format("{}{}: the value is empty, like that of a variable that is not set; {} would be right",
                           place, option->get_name(),
                           option->get_positional() ? option->get_description() : kindOf(*option));
      if (!option->get_positional() && optionOf(command, value) != nullptr)
        return fmt::format("{}{}: {} is missing: what follows is the option {}", place, option->get_name(),
                           kindOf(*option), value);
    }
  }
  return "";
}

/// "" where none of the command's options was given too often.
std::string countMistake(const CLI::App& command, const std::string& place) {
  for (const CLI::Option* option : command.get_options()) {
    const auto& values = option->results();
    const auto most = static_cast<std::size_t>(std::max(option->get_items_expected_max(), 1));
    if (!takesValue(*option) || option->get_multi_option_policy() != CLI::MultiOptionPolicy::Throw ||
        values.size() <= most)
      continue;
    std::vector<std::string> given;  // each time, of all words of its value
    for (std::size_t at = 0; at < values.size(); at += most)
      given.push_back(fmt::format(
          "{}", fmt::join(values.begin() + static_cast<std::ptrdiff_t>(at),
                          values.begin() + static_cast<std::ptrdiff_t>(std::min(at + most, values.size())), " ")));
    return fmt::format("{}{} is given {}, as {}; once would be right", place, option->get_name(),
                       given.size() == 2 ? "twice" : fmt::format("{} times", given.size()),
                       fmt::join(given, " and as "));
  }
  return "";
}

/// What the command's options ask of one another: "" where it is all there.
std::string companyMistake(const CLI::App& command, const std::string& place) {
  for (const CLI::Option* option : command.get_options()) {
    if (option->count() == 0) continue;
    for (const CLI::Option* other : option->get_needs())
      if (other->count() == 0)
        return fmt::format("{}{} is of use only with {}, which is missing", place, option->get_name(),
                           optionName(*other));
    for (const CLI::Option* other : option->get_excludes())
      if (other->count() != 0)
        return fmt::format("{}{} and {} do not go together; one of them would be right", place, option->get_name(),
                           other->get_name());
  }
  return "";
}

bool isOption(const std::string& word) { return word.starts_with('-') && word != "-"; }

/// An option that there is not, or that stands before the command. "" where there is none.
std::string optionMistake(const CLI::App& app, const CLI::App& command, const std::string& place) {
  for (const std::string& word : app.remaining(false)) {
    if (!isOption(word)) continue;
    return &command != &app && optionOf(command, word) != nullptr
               ? fmt::format("{} stands before the command; 'tessera {} {} ...' would be right", word,
                             command.get_name(), word)
               : noOption(app, word, "");
  }
  for (const std::string& word : command.remaining(false))
    if (isOption(word)) return noOption(command, word, place);
  return "";
}

/// A word that nothing takes. "" where there is none.
std::string wordMistake(const CLI::App& app, const CLI::App& command, const std::string& place) {
  if (const auto before = app.remaining(false); !before.empty()) return noCommand(app, before.front());
  const auto extras = command.remaining(false);
  if (extras.empty()) return "";
  return fmt::format("{}'{}' is one word too many{}", place, extras.front(), usageHint(command));
}

/// The command that was named, else the program.
const CLI::App& commandOf(const CLI::App& app) {
  const auto parsed = app.get_subcommands();
  return parsed.empty() ? app : *parsed.front();
}

std::string placeOf(const CLI::App& command) { return command.get_parent() ? command.get_name() + ": " : ""; }

std::string firstOf(std::initializer_list<std::string> texts) {
  const auto found = std::ranges::find_if(texts, [](const std::string& text) { return !text.empty(); });
  return found == texts.end() ? "" : *found;
}

/// CLI11 names the option at the beginning of its message.
const CLI::Option* namedBy(const CLI::App& command, const CLI::ParseError& error) {
  const std::string text = error.what();
  for (const CLI::Option* option : command.get_options())
    if (text.starts_with(option->get_name() + ":")) return option;
  return nullptr;
}

/// The command's first example; of an option the first that has it.
std::string exampleText(const CLI::App& command, const CLI::Option* option = nullptr) {
  for (const std::string& example : examplesOf(command)) {
    std::istringstream words(example);
    const std::vector<std::string> all{std::istream_iterator<std::string>(words), {}};
    const bool has = option == nullptr || std::ranges::any_of(all, [&](const std::string& word) {
                       return optionOf(command, word) == option;
                     });
    if (has && all.size() > 1 && all[1] == command.get_name()) return "; for example: " + example;
  }
  return usageHint(command);
}

}  // namespace

std::string mistakeText(const CLI::App& app, const std::vector<std::string>& words) {
  const CLI::App& command = commandOf(app);
  if (command.get_group().empty()) return "";  // what shells and sweeps call, with words of any kind
  const std::string place = placeOf(command);
  return firstOf({equalsMistake(command, words, place), valueMistake(command, place)});
}

std::string mistakeText(const CLI::App& app, const std::vector<std::string>& words, const CLI::ParseError& error) {
  const CLI::App& command = commandOf(app);
  const std::string place = placeOf(command);
  const std::string noSuchOption = optionMistake(app, command, place), tooMany = wordMistake(app, command, place);
  // Help of what is no command is none.
  if (error.get_exit_code() == 0) return &command == &app ? firstOf({noSuchOption, tooMany}) : "";
  // An option comes before a word: what follows it may be its value.
  const std::string mistake = firstOf({equalsMistake(command, words, place), noSuchOption, mistakeText(app, words),
                                       tooMany, countMistake(command, place)});
  if (!mistake.empty()) return mistake;
  if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr)
    for (const CLI::Option* option : command.get_options())
      if (option->get_required() && option->count() == 0)
        return fmt::format("{}{} is missing: {}{}", place, optionName(*option), option->get_description(),
                           exampleText(command));
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr)
    if (const CLI::Option* const option = namedBy(command, error))
      return fmt::format("{}{}: {} is missing: {}{}", place, option->get_name(), kindOf(*option),
                         option->get_description(), exampleText(command, option));
  if (const std::string company = companyMistake(command, place); !company.empty()) return company;
  return fmt::format("{}{}{}", place, error.what(), usageHint(command));
}

}  // namespace tessera::cli
