#include "host/cli/mistake.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "host/cli/help.h"
#include "host/error.h"
#include "host/suggest.h"
#include "host/variant.h"

namespace tessera::cli {
namespace {

/// Words of others for what a command does, and for what an option says.
const std::vector<std::pair<std::string, std::string>> kOtherWords{
    {"draw", "render"},           {"run", "render"},          {"time", "render"},         {"bench", "render"},
    {"benchmark", "render"},      {"view", "render"},         {"diff", "compare"},        {"check", "parity"},
    {"test", "parity"},           {"verify", "parity"},       {"axes", "variants"},       {"list", "devices"},
    {"info", "devices"},          {"gpus", "devices"},        {"compile", "kernels"},     {"emit", "kernels"},
    {"experiment", "sweep"},      {"plot", "report"},         {"complete", "completion"}, {"--width", "--size"},
    {"--height", "--size"},       {"--resolution", "--size"}, {"--res", "--size"},        {"--gpu", "--device"},
    {"--cpu", "--device"},        {"--backend", "--device"},  {"--axis", "--set"},        {"--frames", "--repeat"},
    {"--iterations", "--repeat"}, {"--runs", "--repeat"},     {"--jobs", "--threads"},    {"-j", "--threads"},
    {"-n", "--repeat"},           {"-t", "--threads"},        {"-s", "--size"},           {"-d", "--device"},
    {"--silent", "--quiet"},      {"--field", "--attribute"}, {"--value", "--attribute"}};

std::string meant(const std::string& typed, const std::vector<std::string>& known) {
  for (const auto& [other, ours] : kOtherWords)
    if (other == typed && std::ranges::find(known, ours) != known.end()) return ours;
  return nearest(typed, known);
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
  return fmt::format(
      "no command '{}'; {}", typed,
      close.empty() ? whatThereIs(typed, names) : fmt::format("did you mean {}? 'tessera help' lists them", close));
}

std::string noOption(const CLI::App& command, const std::string& typed, const std::string& place) {
  const std::string name = typed.substr(0, typed.find('='));
  std::vector<std::string> names;
  for (const CLI::Option* option : optionsOf(command, false)) {
    for (const auto& part : option->get_lnames()) names.push_back("--" + part);
    for (const auto& part : option->get_snames()) names.push_back("-" + part);
  }
  std::string close = meant(name, names);
  const std::vector<std::string> axisNames = namesOf(axes(), &Axis::name);
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

std::string mistakeText(const CLI::App& app, const CLI::ParseError& error) {
  const auto parsed = app.get_subcommands();
  const CLI::App& command = parsed.empty() ? app : *parsed.front();
  const std::string place = parsed.empty() ? "" : command.get_name() + ": ";
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {
    const auto extras = app.remaining(true);
    const std::string first = extras.empty() ? "" : extras.front();
    if (first.starts_with('-')) return noOption(command, first, place);
    if (parsed.empty()) return noCommand(app, first);
    return fmt::format("{}'{}' is one word too many; 'tessera {} --help' shows the usage", place, first,
                       command.get_name());
  }
  if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr)
    for (const CLI::Option* option : command.get_options())
      if (option->get_required() && option->count() == 0) {
        const auto examples = examplesOf(command);
        return fmt::format("{}{} is missing: {}{}", place, optionName(*option), option->get_description(),
                           examples.empty() ? "" : fmt::format("; for example: {}", examples.front()));
      }
  return fmt::format("{}{}; '{} --help' shows the usage", place, error.what(),
                     parsed.empty() ? "tessera" : "tessera " + command.get_name());
}

}  // namespace tessera::cli
