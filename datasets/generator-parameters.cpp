#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tessera/error.h>

#include <algorithm>
#include <cmath>

#include "datasets/generators.h"
#include "datasets/text.h"
#include "host/support/suggest.h"

namespace tessera {
namespace {

std::string rangeText(const datasets::GeneratorParameter& p) {
  if (!p.choices.empty()) return fmt::format("{}", fmt::join(p.choices, " or "));
  return fmt::format("{}{} to {}", p.whole ? "" : "real ", p.least, p.most);
}

double parseValue(const datasets::Generator& generator, const datasets::GeneratorParameter& p, std::string_view text) {
  if (!p.choices.empty()) {
    const auto found = std::ranges::find(p.choices, text);
    if (found != p.choices.end()) return static_cast<double>(found - p.choices.begin());
  } else {
    const auto whole = datasets::toInteger(text);
    const auto real = datasets::toReal(text);
    const double value = whole ? static_cast<double>(*whole) : real && !p.whole ? double{*real} : std::nan("");
    if (value >= p.least && value <= p.most) return value;
  }
  failUsage(fmt::format("generate:{}: {}={} is not {}", generator.name, p.name, text, rangeText(p)));
}

}  // namespace

namespace datasets {

ParsedGenerator parseGenerator(std::string_view spec) {
  const std::size_t question = std::min(spec.find('?'), spec.size());
  const std::string_view name = spec.substr(0, question);
  const auto& all = generators();
  const auto found = std::ranges::find(all, name, &Generator::name);
  if (found == all.end()) {
    const auto names = support::namesOf(all, &Generator::name);
    if (name.empty()) failUsage(fmt::format("generate: of what? There are {}", fmt::join(names, ", ")));
    failUsage(fmt::format("generate:{}: no such generator; {}", name, support::whatThereIs(name, names)));
  }
  ParsedGenerator parsed{&*found, {}};
  for (const auto& p : found->parameters) parsed.values.push_back(p.initial);
  std::vector<bool> given(found->parameters.size());
  std::string_view rest = question < spec.size() ? spec.substr(question + 1) : std::string_view{};
  while (!rest.empty()) {
    const std::string_view setting = rest.substr(0, rest.find('&'));
    rest.remove_prefix(std::min(setting.size() + 1, rest.size()));
    const std::size_t equals = setting.find('=');
    const auto parameter = std::ranges::find(found->parameters, setting.substr(0, equals), &GeneratorParameter::name);
    if (parameter == found->parameters.end()) {
      const auto names = support::namesOf(found->parameters, &GeneratorParameter::name);
      failUsage(fmt::format("generate:{}: no parameter '{}'; {}", name, setting.substr(0, equals),
                            support::whatThereIs(setting.substr(0, equals), names)));
    }
    if (equals == setting.npos)
      failUsage(fmt::format("generate:{}: '{}' has no value; {}=VALUE of {} would be right", name, setting, setting,
                            rangeText(*parameter)));
    const auto at = static_cast<std::size_t>(parameter - found->parameters.begin());
    if (given[at]) failUsage(fmt::format("generate:{}: {} is given twice", name, parameter->name));
    given[at] = true;
    parsed.values[at] = parseValue(*found, *parameter, setting.substr(equals + 1));
  }
  return parsed;
}

}  // namespace datasets

const std::vector<GeneratorDoc>& generatorDocs() {
  static const std::vector<GeneratorDoc> docs = [] {
    std::vector<GeneratorDoc> list;
    for (const datasets::Generator& generator : datasets::generators()) {
      std::string parameters;
      for (const auto& p : generator.parameters) {
        const std::string initial =
            p.choices.empty() ? fmt::format("{}", p.initial) : p.choices[static_cast<std::size_t>(p.initial)];
        parameters += fmt::format("{}{}={} ({})", parameters.empty() ? "" : ", ", p.name, initial, rangeText(p));
      }
      list.push_back({generator.name, parameters, generator.makes});
    }
    return list;
  }();
  return docs;
}

}  // namespace tessera
