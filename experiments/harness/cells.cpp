#include "experiments/harness/cells.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

#include "datasets/random.h"
#include "host/devices/open.h"

namespace tessera::harness {
namespace {

constexpr std::string_view kKernel = "kernel:";

bool hasAll(const Variant& asked, const Variant& values) {
  return std::ranges::all_of(values.values(),
                             [&](const auto& value) { return asked.get(value.first) == value.second; });
}

/// A cell without its place: what it is made of.
SweepPoint cellOf(const Sweep& sweep, const Labels& labels) {
  SweepPoint cell;
  cell.labels = labels;
  for (const auto& [name, value] : labels) {
    if (!name.starts_with(kKernel)) {
      cell.asked.set(name, value);
      continue;
    }
    const std::string stage = name.substr(kKernel.size());
    const SweptKernel& kernel = *std::ranges::find(sweep.kernels, stage, &SweptKernel::stage);
    const auto place = std::ranges::find(kernel.texts, value) - kernel.texts.begin();
    if (!value.empty()) cell.kernels[stage] = kernel.files[static_cast<std::size_t>(place)];
  }
  return cell;
}

/// A word for sh.
std::string quoted(const std::string& text) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./:=,+@%-";
  if (!text.empty() && text.find_first_not_of(kPlain) == std::string::npos) return text;
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

/// FNV-1a (Fowler, Noll and Vo): the same on every machine, as std::hash is not.
std::uint64_t hashOf(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const unsigned char c : text) hash = (hash ^ c) * 0x100000001b3u;
  return hash;
}

}  // namespace

std::vector<SweepPoint> cells(const Sweep& sweep) {
  std::vector<SweepPoint> variants;
  for (const Labels& labels : combinations(sweep)) variants.push_back(cellOf(sweep, labels));
  const auto reference =
      std::ranges::find_if(variants, [&](const SweepPoint& cell) { return hasAll(cell.asked, sweep.reference); });
  if (reference != variants.end()) reference->reference = true;

  std::vector<SweepPoint> all;
  std::size_t group = 0;
  const auto addGroup = [&](const std::string& device, std::size_t scene, Size size, unsigned threads) {
    const auto add = [&](SweepPoint cell, bool twin) {
      cell.number = all.size();
      cell.scene = scene;
      cell.size = size;
      cell.device = device;
      cell.threads = threads;
      cell.group = group;
      cell.reference &= !twin;
      cell.twin = twin;
      all.push_back(std::move(cell));
    };
    for (const SweepPoint& cell : variants) {
      add(cell, false);
      if (cell.reference) add(cell, true);
    }
    ++group;
  };
  for (const std::string& device : sweep.devices)
    for (std::size_t scene = 0; scene < sweep.scenes.size(); ++scene)
      for (const Size size : sweep.sizes) {
        if (!devices::takesThreads(device)) {
          addGroup(device, scene, size, 0);
          continue;
        }
        for (const unsigned threads : sweep.threads) addGroup(device, scene, size, threads);
      }
  return all;
}

void makeReference(std::vector<SweepPoint>& cells, std::size_t number) {
  const SweepPoint chosen = cells.at(number);
  for (SweepPoint& cell : cells) {
    if (cell.group != chosen.group) continue;
    cell.reference = cell.number == number;
    if (!cell.twin) continue;
    cell.asked = chosen.asked;
    cell.kernels = chosen.kernels;
    cell.labels = chosen.labels;
  }
}

bool chooseReferences(const Sweep& sweep, std::vector<SweepPoint>& cells,
                      const std::function<bool(std::size_t)>& refused) {
  if (!sweep.reference.values().empty()) return false;
  bool changed = false;
  std::optional<std::size_t> done;  // the group whose reference stands
  for (std::size_t number = 0; number < cells.size(); ++number) {
    const SweepPoint& cell = cells[number];
    if (cell.twin || cell.group == done || refused(number)) continue;
    done = cell.group;
    if (cell.reference) continue;
    makeReference(cells, number);
    changed = true;
  }
  return changed;
}

std::vector<Job> jobs(const Sweep& sweep, const std::vector<SweepPoint>& cells) {
  std::vector<Job> jobs;
  for (const SweepPoint& cell : cells) {
    if (jobs.empty() || jobs.back().scene != cell.scene || jobs.back().device != cell.device)
      jobs.push_back({sweep.scenes[cell.scene].name + "@" + cell.device, cell.scene, cell.device, {}});
    jobs.back().cells.push_back(cell.number);
  }
  return jobs;
}

std::string variantName(const Sweep& sweep, const SweepPoint& cell) {
  std::vector<std::string> parts;
  for (const SweptAxis& axis : sweptAxes(sweep))
    if (const auto found = cell.labels.find(axis.axis); found != cell.labels.end())
      parts.push_back(fmt::format("{}={}", axis.axis, found->second.empty() ? "own" : found->second));
  return fmt::format("{}", fmt::join(parts, " "));
}

std::string cellName(const Sweep& sweep, const SweepPoint& cell) {
  std::string name =
      fmt::format("{} {}x{} {}", sweep.scenes[cell.scene].name, cell.size.width, cell.size.height, cell.device);
  if (cell.threads != 0) name += fmt::format(" {} thread{}", cell.threads, cell.threads == 1 ? "" : "s");
  if (const std::string variant = variantName(sweep, cell); !variant.empty()) name += ", " + variant;
  return cell.twin ? name + " (again)" : name;
}

std::string commandText(const Command& parts) {
  std::string command = fmt::format("tessera render {} --size {}x{} --device {}", quoted(parts.input), parts.size.width,
                                    parts.size.height, quoted(parts.device));
  if (parts.threads != 0) command += fmt::format(" --threads {}", parts.threads);
  for (const Axis& axis : allAxes())
    if (const auto found = parts.labels.find(axis.name); found != parts.labels.end())
      command += " --set " + quoted(axis.name + "=" + found->second);
  for (const auto& [name, value] : parts.labels)
    if (name.starts_with(kKernel) && !value.empty())
      command += " --kernel " + quoted(name.substr(kKernel.size()) + "=" + value);
  if (!parts.attribute.empty()) command += " --attribute " + quoted(parts.attribute);
  if (!parts.range.empty()) command += " --range " + parts.range;
  return command + fmt::format(" --repeat {} --error --json -", parts.frames);
}

std::string cellCommand(const Sweep& sweep, const SweepPoint& cell) {
  const SweepScene& scene = sweep.scenes[cell.scene];
  const auto& range = scene.attribute.range;
  return commandText({.input = scene.text.starts_with('-') ? "./" + scene.text : scene.text,  // no option
                      .size = cell.size,
                      .device = cell.device,
                      .threads = cell.threads,
                      .labels = cell.labels,
                      .attribute = scene.attribute.name,
                      .range = range ? fmt::format("{},{}", range->least, range->most) : "",
                      .frames = sweep.rounds * sweep.repeats});
}

std::vector<std::string> commandWords(std::string_view command) {
  std::vector<std::string> words(1);
  bool isQuoted = false;
  for (std::size_t i = 0; i < command.size(); ++i) {
    if (command[i] == '\'')
      isQuoted = !isQuoted;
    else if (command[i] == ' ' && !isQuoted)
      words.emplace_back();
    else if (command[i] == '\\' && !isQuoted && i + 1 < command.size())
      words.back() += command[++i];
    else
      words.back() += command[i];
  }
  return words;
}

std::vector<std::size_t> turnOrder(std::vector<std::size_t> cells, std::uint64_t seed, const std::string& job,
                                   unsigned round) {
  datasets::Random jobs(datasets::Random(seed).bits() ^ hashOf(job));
  datasets::Random random(jobs.bits() + round);
  for (std::size_t i = cells.size(); i > 1; --i) std::swap(cells[i - 1], cells[random.bits() % i]);
  return cells;
}

}  // namespace tessera::harness
