#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tessera/counters.h>
#include <tessera/error.h>
#include <tessera/variant.h>

#include <algorithm>
#include <charconv>

#include "host/axes/settings.h"
#include "host/support/suggest.h"

namespace tessera {
namespace {

using enum AxisKind;

void checkNumber(const Axis& axis, std::string_view text) {
  long number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size() || number < axis.least || number > axis.most)
    failUsage(fmt::format("--set {}={}: takes an integer from {} to {}", axis.name, text, axis.least, axis.most));
}

[[noreturn]] void failWithoutValue(const Axis& axis) {
  failUsage(axis.values.empty() ? fmt::format("--set {0}: has no value; {0}={1} to {0}={2} would be right", axis.name,
                                              axis.least, axis.most)
                                : fmt::format("--set {0}: has no value; {0}={1} would be right", axis.name,
                                              fmt::join(support::namesOf(axis.values, &AxisValue::name), " or ")));
}

}  // namespace

const char* kindName(AxisKind kind) {
  return kind == kImage ? "image" : kind == kImplementation ? "implementation" : "approximate";
}

AxisKind Axis::kind() const {
  const auto is = [this](AxisKind k) {
    return std::ranges::any_of(values, [k](const AxisValue& v) { return v.kind == k; });
  };
  return is(kImplementation) || values.empty() ? kImplementation : kImage;
}

const Axis& axis(std::string_view name) {
  const auto found = std::ranges::find(allAxes(), name, &Axis::name);
  if (found != allAxes().end()) return *found;
  failUsage(fmt::format("--set {}: no such axis; {}", name,
                        support::whatThereIs(name, support::namesOf(allAxes(), &Axis::name))));
}

const AxisValue& axisValue(std::string_view axisName, std::string_view name) {
  const Axis& a = axis(axisName);
  const auto found = std::ranges::find(a.values, name, &AxisValue::name);
  if (found != a.values.end()) return *found;
  failUsage(fmt::format("--set {}={}: no such value; {}", a.name, name,
                        support::whatThereIs(name, support::namesOf(a.values, &AxisValue::name))));
}

const CommitTraits& commitTraits(std::string_view commit) {
  return std::get<CommitTraits>(axisValue("commit", commit).traits);
}

LoopBound loopBound(const Variant& resolved) {
  LoopBound sum;
  for (const Axis& axis : allAxes()) {
    if (axis.values.empty() || !resolved.has(axis.name)) continue;
    if (const auto* bound = std::get_if<LoopBound>(&axisValue(axis.name, resolved.get(axis.name)).traits)) {
      sum.perCell += bound->perCell;
      sum.perRow += bound->perRow;
      sum.fixed += bound->fixed;
      sum.once += bound->once;
    }
  }
  return sum;
}

Variant::Variant(std::initializer_list<std::pair<std::string_view, std::string_view>> settings) {
  for (const auto& [name, value] : settings) set(name, value);
}

Variant::Variant(std::string_view settings) {
  for (const std::string& setting : axes::settingsIn(settings)) {
    const auto equals = setting.find('=');
    const std::string name = setting.substr(0, equals);
    if (equals == std::string::npos) failWithoutValue(axis(name));
    if (has(name)) failUsage(fmt::format("--set {}: {} is set twice; once would do", setting, name));
    set(name, setting.substr(equals + 1));
  }
}

void Variant::set(std::string_view name, std::string_view value) {
  const Axis& a = axis(name);
  if (a.values.empty())
    checkNumber(a, value);
  else
    axisValue(a.name, value);
  values_[a.name] = value;
}

bool Variant::has(std::string_view name) const { return values_.contains(std::string(name)); }

std::string Variant::get(std::string_view name, std::string_view otherwise) const {
  const auto found = values_.find(std::string(name));
  return found == values_.end() ? std::string(otherwise) : found->second;
}

std::uint32_t Variant::number(std::string_view name) const {
  const std::string text = get(name);
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size())
    fail(fmt::format("axis {}: '{}' is not a number", name, text));
  return value;
}

bool Variant::is(std::string_view name, std::string_view value) const {
  return get(name) == axisValue(name, value).name;
}

std::string Variant::text() const {
  std::vector<std::string> parts;
  for (const Axis& a : allAxes())
    if (has(a.name)) parts.push_back(a.name + "=" + get(a.name));
  return fmt::format("{}", fmt::join(parts, " "));
}

bool isApproximate(const Variant& variant) {
  return std::ranges::any_of(variant.values(), [](const auto& set) {
    const Axis& a = axis(set.first);
    return !a.values.empty() && axisValue(a.name, set.second).kind == AxisKind::kApproximate;
  });
}

VariantModules variantModules(std::string_view stage, const Variant& resolved) {
  VariantModules modules{"// Generated: the settings of this stage.\nmodule settings;\n",
                         "// Generated: the types that this stage is made of.\nmodule variant;\n"};
  std::string& text = modules.settings;
  for (const Axis& a : allAxes())
    if (std::ranges::find(a.stages, stage) != a.stages.end()) {
      if (a.name == "lane-width" && !resolved.is(a.name, "native")) modules.laneWidth = resolved.number(a.name);
      (a.types ? modules.variant : text) += axisValue(a.name, resolved.get(a.name)).slang;
    }
  text += fmt::format("public static const int kCounterCount = {};\n", kernelCounterCount());
  for (std::size_t i = 0; i < kernelCounterCount(); ++i) {
    std::string name = counterDocs()[i].name;
    name[0] = static_cast<char>(std::toupper(name[0]));
    text += fmt::format("public static const uint kCount{} = {};\n", name, i);
  }
  return modules;
}

}  // namespace tessera
