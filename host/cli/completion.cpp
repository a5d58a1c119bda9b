#include "host/cli/completion.h"

#include <tessera/variant.h>

#include <algorithm>
#include <optional>

#include "datasets/generators.h"
#include "datasets/installed-mesh.h"
#include "host/cli/help.h"
#include "host/devices/open.h"
#include "host/kernels/emit.h"
#include "host/plan/stages.h"

namespace tessera::cli {
namespace {

using Candidates = std::vector<Candidate>;

/// The part of `word` up to and with the last of `marks`: what is settled.
std::string upTo(const std::string& word, const char* marks) {
  const std::size_t at = word.find_last_of(marks);
  return at == std::string::npos ? "" : word.substr(0, at + 1);
}

Candidates axisSettings(const std::string& word) {
  const std::string before = upTo(word, ", "), setting = word.substr(before.size());
  const std::size_t equals = setting.find('=');
  Candidates all;
  for (const Axis& axis : allAxes()) {
    if (equals == setting.npos) all.push_back({before + axis.name + "=", axis.meaning});
    if (equals == setting.npos || axis.name != setting.substr(0, equals)) continue;
    for (const AxisValue& value : axis.values) all.push_back({before + axis.name + "=" + value.name, value.meaning});
  }
  return all;
}

Candidates devices(const std::string& word) {
  const std::string before = upTo(word, ",");
  Candidates all;
  for (const DeviceKind& kind : deviceKinds()) all.push_back({before + kind.name, kind.meaning});
  for (const DeviceKind& kind : deviceKinds())
    for (const FoundDevice& device : kind.find().devices)
      if (device.whyNot.empty() && !device.select.empty())
        all.push_back({before + devices::nameOf(kind, device), device.name});
  return all;
}

Candidates generated(const std::string& word) {
  constexpr std::string_view kGenerate = "generate:";
  const std::size_t question = word.find('?');
  Candidates all;
  for (const datasets::Generator& generator : datasets::generators()) {
    const std::string name = std::string(kGenerate) + generator.name;
    if (question == word.npos) {
      all.push_back({name, generator.makes});
      continue;
    }
    if (name != word.substr(0, question)) continue;
    const std::string before = upTo(word, "?&"), setting = word.substr(before.size());
    for (const datasets::GeneratorParameter& p : generator.parameters) {
      if (setting.find('=') == setting.npos) all.push_back({before + p.name + "=", ""});
      if (setting.starts_with(p.name + "="))
        for (const std::string& choice : p.choices) all.push_back({before + p.name + "=" + choice, ""});
    }
  }
  return all;
}

Candidates inputs(const std::string& word) {
  if (word.starts_with("generate:")) return generated(word);
  Candidates all;
  if (!word.starts_with(datasets::kInstalledMesh))
    return {{"mesh:", "an installed mesh"}, {"generate:", "a generated mesh"}, {":files", ""}};
  for (const std::string& name : datasets::installedMeshes())
    all.push_back({std::string(datasets::kInstalledMesh) + name, ""});
  return all;
}

Candidates kernelFiles(const std::string& word) {
  Candidates all;
  if (const std::string stage = upTo(word, "="); !stage.empty()) return {{":files " + stage, ""}};
  for (const plan::Stage& stage : plan::stages()) all.push_back({stage.name + "=", stage.source});
  return all;
}

/// A format before the name, as in png:picture, is settled.
Candidates imageFiles(const std::string& word) {
  for (const std::string format : {"png:", "exr:"})
    if (word.starts_with(format)) return {{":files " + format, ""}};
  return {{":files", ""}};
}

Candidates channels(const std::string& word) {
  if (word.find('=') != word.npos) return {};  // an amount
  constexpr const char* kAmount = "a number, or float32 steps as in 2ulp";
  return {{"depth=", kAmount}, {"values=", kAmount}, {"colour=", kAmount}};
}

Candidates words(std::initializer_list<const char*> list) {
  Candidates all;
  for (const char* const word : list) all.push_back({word, ""});
  return all;
}

/// What an option's value, or an argument, may be, by the name that help has for it.
Candidates valuesOf(const CLI::App& app, const std::string& kind, const std::string& word) {
  if (kind == "AXIS=VALUE") return axisSettings(word);
  if (kind.starts_with("DEVICE")) return devices(word);
  if (kind == "STAGE=FILE") return kernelFiles(word);
  if (kind == "INPUT") return inputs(word);
  if (kind == "SHELL") return words({"bash", "zsh", "fish"});
  if (kind == "NAME") return words({"x", "y", "z"});
  if (kind == "CHANNEL=AMOUNT") return channels(word);
  if (kind == "DIR" || kind == "FOLDER") return {{":folders", ""}};
  if (kind == "IMAGE" || kind == "IMAGE.png") return imageFiles(word);
  if (kind == "TARGET DIR") {
    Candidates all;
    for (const kernels::EmitTarget& target : kernels::emitTargets()) all.push_back({target.name, ""});
    return all;
  }
  if (kind == "COMMAND") {
    Candidates all;
    for (const CLI::App* command : commandsOf(app)) all.push_back({command->get_name(), command->get_description()});
    return all;
  }
  const bool named = kind.starts_with("FILE") || kind == "SWEEP" || kind == "A" || kind == "B";
  return named ? Candidates{{":files", ""}} : Candidates{};
}

const CLI::Option* optionNamed(const CLI::App& command, const std::string& name) {
  for (const CLI::Option* option : optionsOf(command, false))
    if (option->check_name(name)) return option;
  return nullptr;
}

/// What is left of the words before the current one: the option whose value is next, or how many arguments there were.
struct Place {
  const CLI::Option* option = nullptr;
  int value = 0;  ///< of the option, from 0
  std::size_t arguments = 0;
};

Place placeAfter(const CLI::App& command, const std::vector<std::string>& words) {
  Place place;
  for (const std::string& word : words) {
    if (place.option != nullptr && ++place.value < place.option->get_type_size_max()) continue;
    if (place.option != nullptr) {
      place.option = nullptr;
    } else if (!word.starts_with('-') || word == "-") {
      ++place.arguments;
    } else if (word.find('=') == word.npos) {
      const CLI::Option* const option = optionNamed(command, word);
      if (option != nullptr && takesValue(*option)) place.option = option;
      place.value = 0;
    }
  }
  return place;
}

Candidates all(const CLI::App& app, const std::vector<std::string>& words) {
  const std::string& word = words.back();
  const auto commands = commandsOf(app);
  const auto first = words.begin(), last = words.end() - 1;
  const auto isCommand = [&](const std::string& w) {
    return std::ranges::any_of(commands, [&](const CLI::App* command) { return command->get_name() == w; });
  };
  const auto name = std::find_if(first, last, isCommand);
  const CLI::App& command = name == last ? app : *app.get_subcommand(*name);
  const Place place = placeAfter(command, name == last ? std::vector<std::string>{} : std::vector(name + 1, last));
  if (place.option != nullptr) {
    const std::string kind = place.option->get_type_name();
    return place.value > 0 ? Candidates{{":folders", ""}} : valuesOf(app, kind, word);
  }
  if (const std::size_t equals = word.find('='); word.starts_with("--") && equals != word.npos) {
    const CLI::Option* const option = optionNamed(command, word.substr(0, equals));
    if (option == nullptr) return {};
    const std::string before = word.substr(0, equals + 1);
    Candidates found = valuesOf(app, option->get_type_name(), word.substr(equals + 1));
    for (Candidate& candidate : found) {
      const bool names = candidate.word.starts_with(':');
      if (names && candidate.word.find(' ') == candidate.word.npos) candidate.word += ' ';
      candidate.word.insert(names ? candidate.word.find(' ') + 1 : 0, before);
    }
    return found;
  }
  Candidates found;
  if (word.starts_with('-')) {
    for (const CLI::Option* option : optionsOf(command, false)) {
      for (const auto& part : option->get_lnames()) found.push_back({"--" + part, option->get_description()});
      for (const auto& part : option->get_snames()) found.push_back({"-" + part, option->get_description()});
    }
    return found;
  }
  if (name == last) return valuesOf(app, "COMMAND", word);
  const auto positional = optionsOf(command, true);
  if (place.arguments >= positional.size()) return {};
  return valuesOf(app, positional[place.arguments]->get_name(true, false), word);
}

}  // namespace

std::vector<Candidate> candidates(const CLI::App& app, const std::vector<std::string>& words) {
  Candidates found = all(app, words);
  std::erase_if(found, [&](const Candidate& candidate) {
    return !candidate.word.starts_with(':') && !candidate.word.starts_with(words.back());
  });
  return found;
}

}  // namespace tessera::cli
