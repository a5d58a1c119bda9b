#include "experiments/harness/sweep-file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tessera/error.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "datasets/generators.h"
#include "datasets/installed-mesh.h"
#include "datasets/text.h"
#include "datasets/toml-table.h"
#include "experiments/harness/axis-values.h"
#include "experiments/harness/report-keys.h"
#include "host/devices/open.h"
#include "host/kernels/user-kernel.h"
#include "host/plan/stages.h"
#include "host/support/file-faults.h"
#include "host/support/sha256.h"
#include "host/support/suggest.h"
#include "host/support/text.h"

namespace tessera::harness {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxCells = 100'000;
constexpr std::int64_t kMaxThreads = 4096;

/// The table at `key`, of which the file chooses the keys; empty where there is none.
datasets::TomlTable section(const datasets::TomlTable& top, std::string_view key) {
  static const toml::table kNone;
  const toml::node* const node = top.find(key);
  if (node && !node->is_table()) top.refuse(key, *node, fmt::format("[{}] would be right", key));
  return {top.file(), node ? *node->as_table() : kNone, fmt::format("{}.", key)};
}

/// The tables of [[key]].
std::vector<const toml::table*> sections(const datasets::TomlTable& top, std::string_view key) {
  const toml::node* const node = top.find(key);
  if (!node) return {};
  if (!node->is_array_of_tables()) top.refuse(key, *node, fmt::format("[[{}]] would be right", key));
  std::vector<const toml::table*> tables;
  for (const toml::node& element : *node->as_array()) tables.push_back(element.as_table());
  return tables;
}

template <typename T>
void addOnce(const datasets::TomlTable& table, std::string_view key, const toml::node& node, std::vector<T>& values,
             T value) {
  if (std::ranges::find(values, value) != values.end()) table.refuse(key, node, "is there twice; once would be right");
  values.push_back(std::move(value));
}

std::string textOf(const datasets::TomlTable& table, std::string_view key, const toml::node& node,
                   std::string_view what) {
  const auto text = node.value_exact<std::string>();
  if (!text) table.refuse(key, node, fmt::format("{} would be right", what));
  return *text;
}

/// What `action` throws, said at the node.
template <typename Action>
auto at(const datasets::TomlTable& table, std::string_view key, const toml::node& node, const Action& action) {
  try {
    return action();
  } catch (const Error& error) {
    if (error.code() != ExitCode::kUsage) throw;
    table.refuse(key, node, error.what());
  }
}

// ---- scenes

/// The input as loadInput takes it. Whether the file can be read shows when it is loaded.
std::string readInput(const datasets::TomlTable& table, std::string_view key, const toml::node& node,
                      const fs::path& folder) {
  const std::string text = textOf(table, key, node, "an input as tessera render takes it, in quotes,");
  constexpr std::string_view kGenerate = "generate:";
  if (text.starts_with(kGenerate)) {
    at(table, key, node,
       [&] { return datasets::parseGenerator(std::string_view(text).substr(kGenerate.size())).generator; });
    return text;
  }
  if (text.starts_with(datasets::kInstalledMesh)) {
    at(table, key, node,
       [&] { return datasets::installedMesh(std::string_view(text).substr(datasets::kInstalledMesh.size())); });
    return text;
  }
  const fs::path path = (folder / text).lexically_normal();
  const auto known = {".obj", ".off", ".ply", ".stl", ".toml", ".replay"};
  if (std::ranges::find(known, support::lowerCase(path.extension().string())) == known.end())
    table.refuse(key, node,
                 fmt::format("'{}': generate:NAME, mesh:NAME or a file that ends in {} would be right", text,
                             fmt::join(known, " ")));
  if (const std::string why = support::whyNoFile(path); !why.empty())
    table.refuse(key, node, fmt::format("{}: {}", path.string(), why));
  return path.string();
}

AttributeRequest readAttribute(const datasets::TomlTable& scene, bool generated) {
  AttributeRequest request;
  if (const auto name = scene.line("attribute")) request.name = *name;
  if (generated && !request.name.empty() && !request.isCoordinate())
    scene.refuse("attribute", *scene.find("attribute"),
                 fmt::format("a generator has no '{}'; x, y or z would be right", request.name));
  const auto range = scene.numbers("range", 2);
  if (!range) return request;
  const toml::node& node = *scene.find("range");
  if (request.name.empty())
    scene.refuse("range", node, "there is no attribute for it; attribute = \"z\" would be right");
  request.range = {static_cast<float>((*range)[0]), static_cast<float>((*range)[1])};
  if (!std::isfinite(request.range->least) || !std::isfinite(request.range->most) ||
      request.range->least == request.range->most)
    scene.refuse("range", node, "two different numbers within float32 would be right");
  return request;
}

/// Names become those of folders and files.
bool isSceneName(std::string_view name) {
  const auto good = [](unsigned char c) { return std::isalnum(c) || c == '-' || c == '_' || c == '.'; };
  return !name.empty() && name.size() <= 100 && name[0] != '.' && name[0] != '-' && std::ranges::all_of(name, good);
}

std::vector<SweepScene> readScenes(const datasets::TomlTable& top, const fs::path& folder) {
  top.need("scenes", "[scenes] with a line name = \"INPUT\" each would be right");
  const datasets::TomlTable table = section(top, "scenes");
  std::vector<SweepScene> scenes;
  for (const auto& [key, node] : table.entries()) {
    const std::string name(key.str());
    if (!isSceneName(name))
      table.refuseKey(key,
                      "a scene's name has up to 100 letters, digits, dots, hyphens and underscores, "
                      "and begins with a letter, a digit or an underscore");
    SweepScene scene{.name = name, .input = {}, .text = {}, .attribute = {}, .x = {}};
    if (const toml::table* const fields = node.as_table()) {
      const datasets::TomlTable entry(top.file(), *fields, "a scene", {"source", "x", "attribute", "range"},
                                      "scenes." + name + ".");
      const toml::node& source = entry.need("source", "an input as tessera render takes it would be right");
      scene.input = readInput(entry, "source", source, folder);
      scene.text = *source.value<std::string>();
      scene.attribute = readAttribute(entry, scene.text.starts_with("generate:"));
      scene.x = entry.number("x");
    } else {
      scene.input = readInput(table, name, node, folder);
      scene.text = *node.value<std::string>();
    }
    scenes.push_back(std::move(scene));
  }
  if (scenes.empty()) top.refuse("scenes", *top.find("scenes"), "at least one scene would be right");
  return scenes;
}

// ---- lists of the top level

std::vector<Size> readSizes(const datasets::TomlTable& table) {
  constexpr std::string_view kWhat = "a list of edges, or of [width, height], in pixels,";
  const toml::array* const list = table.list("sizes", kWhat);
  std::vector<Size> sizes;
  if (!list) return sizes;
  for (const toml::node& node : *list) {
    const auto extent = [&](const toml::node& number) {
      const auto value = number.value_exact<std::int64_t>();
      if (!value || *value < 1 || *value > kMaxExtent)
        table.refuse("sizes", number, fmt::format("a whole number of pixels from 1 to {} would be right", kMaxExtent));
      return static_cast<std::uint32_t>(*value);
    };
    const toml::array* const pair = node.as_array();
    if (pair && pair->size() != 2) table.refuse("sizes", node, "[width, height] would be right");
    const Size size = pair ? Size{extent((*pair)[0]), extent((*pair)[1])} : Size{extent(node), extent(node)};
    addOnce(table, "sizes", node, sizes, size);
  }
  return sizes;
}

/// It becomes a part of a folder's name.
bool isDeviceName(std::string_view name) {
  return devices::findKind(name) != nullptr && name.find_first_of("/\r\n") == name.npos;
}

std::vector<std::string> readDevices(const datasets::TomlTable& top) {
  const toml::array* const list =
      top.list("devices", fmt::format("a list such as [\"{}\"]", fmt::join(devices::kindNames(), "\", \"")));
  if (!list) return {devices::defaultDevice()};
  std::vector<std::string> devices;
  for (const toml::node& node : *list) {
    const std::string name = textOf(top, "devices", node, "a device's name in quotes");
    if (!isDeviceName(name))
      top.refuse("devices", node, fmt::format("no device '{}'; {} would be right", name, devices::deviceForms()));
    addOnce(top, "devices", node, devices, name);
  }
  return devices;
}

std::vector<unsigned> readThreads(const datasets::TomlTable& top) {
  const toml::array* const list = top.list("threads", "a list of numbers of threads");
  if (!list) return {0};
  std::vector<unsigned> threads;
  for (const toml::node& node : *list) {
    const auto value = node.value_exact<std::int64_t>();
    if (!value || *value < 0 || *value > kMaxThreads)
      top.refuse("threads", node, fmt::format("a whole number from 0 (all cores) to {} would be right", kMaxThreads));
    addOnce(top, "threads", node, threads, static_cast<unsigned>(*value));
  }
  return threads;
}

// ---- what varies

Variant readVariant(const datasets::TomlTable& table) {
  Variant variant;
  for (const datasets::TomlTable::Entry& entry : table.entries())
    variant.set(entry.key.str(), readAxisValue(table, entry));
  return variant;
}

void refuseSet(const datasets::TomlTable& table, const toml::key& key, const Variant& set) {
  if (set.has(key.str())) table.refuseKey(key, "is in [set], too; one of the two would be right");
}

std::vector<SweptAxis> readAxes(const datasets::TomlTable& table, const Variant& set) {
  std::vector<SweptAxis> swept;
  for (const datasets::TomlTable::Entry& entry : table.entries()) {
    swept.push_back({std::string(entry.key.str()), readAxisValues(table, entry)});
    refuseSet(table, entry.key, set);
  }
  return swept;
}

/// Links are followed on both sides.
bool liesIn(const fs::path& folder, const fs::path& file) {
  std::error_code error;
  const fs::path home = fs::canonical(folder.empty() ? "." : folder, error), real = fs::canonical(file, error);
  return !error && *real.lexically_relative(home).begin() != "..";
}

/// A kernel is native code. What lies beside the sweep came with it; what lies elsewhere was put there by another.
std::string refusalOf(const datasets::TomlTable& table, const std::string& stage, const toml::node& element,
                      const fs::path& file) try {
  table.refuse(
      stage, element,
      fmt::format("{}: lies outside the sweep's folder, and a kernel is native code that runs with your rights; "
                  "--allow-kernels runs it, and so would a copy beside the sweep",
                  file.string()));
} catch (const Error& error) {
  return error.what();
}

std::vector<SweptKernel> readKernels(const datasets::TomlTable& table, const fs::path& folder, std::string& foreign) {
  std::vector<SweptKernel> kernels;
  for (const auto& [key, node] : table.entries()) {
    if (std::ranges::find(plan::stages(), key.str(), &plan::Stage::name) == plan::stages().end()) {
      table.refuseKey(
          key, fmt::format("no such stage; {}",
                           support::whatThereIs(key.str(), support::namesOf(plan::stages(), &plan::Stage::name))));
    }
    SweptKernel kernel{std::string(key.str()), {}, {}};
    for (const toml::node& element : *table.list(key.str(), "a list such as [\"\", \"mine.comp\"]")) {
      const std::string text = textOf(table, key.str(), element, "a file's name, or \"\" for the stage's own kernel,");
      const fs::path file = text.empty() ? fs::path() : (folder / text).lexically_normal();
      if (const std::string why = text.empty() ? "" : support::whyNoFile(file); !why.empty())
        table.refuse(key.str(), element, fmt::format("{}: {}", file.string(), why));
      if (!text.empty()) at(table, key.str(), element, [&] { return kernels::languageOf(file); });
      addOnce(table, key.str(), element, kernel.files, file);
      if (!text.empty() && foreign.empty() && !liesIn(folder, file))
        foreign = refusalOf(table, std::string(key.str()), element, file);
      kernel.texts.push_back(text);
    }
    kernels.push_back(std::move(kernel));
  }
  return kernels;
}

std::vector<Variant> readAlso(const datasets::TomlTable& top, const Variant& set) {
  std::vector<Variant> also;
  for (const toml::table* const one : sections(top, "also")) {
    const datasets::TomlTable table(top.file(), *one, "also.");
    for (const datasets::TomlTable::Entry& entry : table.entries()) refuseSet(table, entry.key, set);
    also.push_back(readVariant(table));
  }
  return also;
}

std::vector<LeaveOut> readLeaveOut(const datasets::TomlTable& top, const Sweep& sweep) {
  Sweep product = sweep;  // [[also]] is outside of it
  product.also.clear();
  const std::vector<SweptAxis> swept = sweptAxes(product);
  std::vector<LeaveOut> all;
  for (const toml::table* const one : sections(top, "leave-out")) {
    const datasets::TomlTable table(top.file(), *one, "leave-out.");
    LeaveOut leaveOut;
    for (const datasets::TomlTable::Entry& entry : table.entries())
      leaveOut.emplace_back(entry.key.str(), readChosen(table, entry, swept));
    if (leaveOut.empty()) top.fail(one->source(), "leave-out: leaves out everything; an axis = value would be right");
    all.push_back(std::move(leaveOut));
  }
  return all;
}

Variant readReference(const datasets::TomlTable& top, const Sweep& sweep) {
  const datasets::TomlTable table = section(top, "reference");
  std::vector<SweptAxis> swept = sweptAxes(sweep);
  std::erase_if(swept, [](const SweptAxis& axis) { return axis.axis.starts_with("kernel:"); });
  Variant reference;
  for (const datasets::TomlTable::Entry& entry : table.entries()) {
    const auto values = readChosen(table, entry, swept);
    if (values.size() != 1) table.refuse(entry.key.str(), entry.node, "one value would be right");
    reference.set(entry.key.str(), values.front());
  }
  return reference;
}

Variant readTruth(const datasets::TomlTable& top) {
  const datasets::TomlTable table = section(top, "truth");
  std::vector<std::string> names;
  for (const Axis& axis : allAxes())
    if (axis.kind() == AxisKind::kImage && axis.name != "shade")
      names.push_back(axis.name);  // the oracle has no colours
  for (const datasets::TomlTable::Entry& entry : table.entries())
    if (std::ranges::find(names, entry.key.str()) == names.end())
      table.refuseKey(entry.key,
                      fmt::format("does not change what is right; {}", support::whatThereIs(entry.key.str(), names)));
  return readVariant(table);
}

// ---- counts

bool hasAll(const Labels& labels, const Variant& values) {
  return std::ranges::all_of(values.values(), [&](const auto& value) {
    const auto found = labels.find(value.first);
    return found != labels.end() && found->second == value.second;
  });
}

void checkCells(const datasets::TomlTable& top, const Sweep& sweep) {
  const toml::source_region& place = (top.has("axes") ? *top.find("axes") : *top.find("scenes")).source();
  double product = 1;
  for (const SweptAxis& axis : sweep.axes) product *= static_cast<double>(axis.values.size());
  for (const SweptKernel& kernel : sweep.kernels) product *= static_cast<double>(kernel.files.size());
  const double groups = static_cast<double>(sweep.scenes.size() * sweep.sizes.size()) *
                        static_cast<double>(sweep.devices.size() * sweep.threads.size());
  const double cells = groups * (product + static_cast<double>(sweep.also.size()));
  if (cells > kMaxCells)
    top.fail(place,
             fmt::format("axes: {:.0f} cells before any is left out; at most {} would be right", cells, kMaxCells));
  const std::vector<Labels> all = combinations(sweep);
  std::set<Labels> seen;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (!seen.insert(all[i]).second) {
      const std::size_t also = i - (all.size() - sweep.also.size());
      top.fail(sections(top, "also")[also]->source(), "also: the sweep has this cell already; once would be right");
    }
  if (std::ranges::any_of(all, [&](const Labels& labels) { return hasAll(labels, sweep.reference); })) return;
  if (const toml::node* const reference = top.find("reference"))
    top.refuse("reference", *reference, "no cell has these values: leave-out takes them all; others would be right");
  top.fail(place, "leave-out: no cell is left; fewer combinations would be right");
}

// ---- the command line

void change(Sweep& sweep, const Changes& changes) {
  if (changes.rounds != 0) sweep.rounds = changes.rounds;
  if (changes.devices.empty()) return;
  sweep.devices.clear();
  for (const std::string& name : changes.devices) {
    if (!isDeviceName(name))
      failUsage(fmt::format("--devices {}: no such device; {} would be right", name, devices::deviceForms()));
    if (std::ranges::find(sweep.devices, name) != sweep.devices.end())
      failUsage(fmt::format("--devices {}: is there twice; once would be right", name));
    sweep.devices.push_back(name);
  }
}

// ---- [quick]

void readQuick(const datasets::TomlTable& top, Sweep& sweep, bool quick) {
  if (quick && !top.has("quick"))
    failUsage(fmt::format("{}: quick: there is no [quick] with the sizes and rounds of a quick run", top.file()));
  if (!top.has("quick")) return;
  section(top, "quick");
  const datasets::TomlTable table(top.file(), *top.find("quick")->as_table(), "[quick]",
                                  {"sizes", "rounds", "repeats", "scenes"}, "quick.");
  Sweep changed = sweep;
  changed.quick = true;
  if (table.has("sizes")) changed.sizes = readSizes(table);
  if (const auto rounds = table.whole("rounds", 1, kMaxRounds)) changed.rounds = static_cast<unsigned>(*rounds);
  if (const auto repeats = table.whole("repeats", 1, kMaxFrames)) changed.repeats = static_cast<unsigned>(*repeats);
  if (const toml::array* const list = table.list("scenes", "a list of names of [scenes]")) {
    std::vector<std::string> names;
    for (const toml::node& node : *list) {
      const std::string name = textOf(table, "scenes", node, "a scene's name in quotes");
      if (std::ranges::find(sweep.scenes, name, &SweepScene::name) == sweep.scenes.end())
        table.refuse("scenes", node,
                     fmt::format("no scene '{}' under [scenes]; {}", name,
                                 support::whatThereIs(name, support::namesOf(sweep.scenes, &SweepScene::name))));
      addOnce(table, "scenes", node, names, name);
    }
    std::erase_if(changed.scenes,
                  [&](const SweepScene& scene) { return std::ranges::find(names, scene.name) == names.end(); });
  }
  if (quick) sweep = std::move(changed);
}

}  // namespace

Sweep readSweep(const fs::path& path, bool quick, const Changes& changes) {
  Sweep sweep;
  sweep.path = fs::absolute(path).lexically_normal();
  sweep.text = datasets::readFile(path);
  sweep.sha256 = support::sha256(sweep.text);
  const fs::path folder = path.parent_path();  // as it was given: messages, and so rows, name no folder of this machine
  const std::string file = path.string();
  const toml::table root = datasets::parseToml(file, sweep.text);
  const datasets::TomlTable top(file, root, "a sweep",
                                {"title",     "question", "sizes",      "scenes", "axes",    "set",     "kernels",
                                 "leave-out", "also",     "reference",  "truth",  "devices", "threads", "rounds",
                                 "warm-up",   "repeats",  "time-limit", "seed",   "plot",    "quick",   "expect"});
  top.need("title", "a line that names the sweep would be right");
  top.need("question", "the question that it answers would be right");
  sweep.title = *top.line("title");
  sweep.question = *top.line("question");
  top.need("sizes", "raster sizes in pixels, e.g. sizes = [1024], would be right");
  sweep.sizes = readSizes(top);
  sweep.scenes = readScenes(top, folder);
  sweep.devices = readDevices(top);
  sweep.threads = readThreads(top);
  sweep.rounds = static_cast<unsigned>(top.whole("rounds", 1, kMaxRounds).value_or(sweep.rounds));
  sweep.warmUp = static_cast<unsigned>(top.whole("warm-up", 0, kMaxFrames).value_or(sweep.warmUp));
  sweep.repeats = static_cast<unsigned>(top.whole("repeats", 1, kMaxFrames).value_or(sweep.repeats));
  sweep.seed = static_cast<std::uint64_t>(top.whole("seed", 0, INT64_MAX).value_or(1));
  sweep.timeLimitS = top.number("time-limit").value_or(sweep.timeLimitS);
  if (!(sweep.timeLimitS > 0)) top.refuse("time-limit", *top.find("time-limit"), "seconds above 0 would be right");

  sweep.set = readVariant(section(top, "set"));
  sweep.axes = readAxes(section(top, "axes"), sweep.set);
  sweep.kernels = readKernels(section(top, "kernels"), folder, sweep.foreignKernel);
  sweep.also = readAlso(top, sweep.set);
  sweep.leaveOut = readLeaveOut(top, sweep);
  sweep.reference = readReference(top, sweep);
  sweep.truth = readTruth(top);
  checkCells(top, sweep);
  if (top.has("plot")) {
    section(top, "plot");
    checkPlot({file,
               *top.find("plot")->as_table(),
               "[plot]",
               {"curve", "against", "x-label", "heat", "error", "figure"},
               "plot."},
              sweep);
  }
  for (const toml::table* const one : sections(top, "expect"))
    checkExpectation(
        {file, *one, "[[expect]]", {"where", "scene", "status", "error", "truth_error", "counters"}, "expect."}, sweep);
  readQuick(top, sweep, quick);
  change(sweep, changes);
  return sweep;
}

std::vector<SweptAxis> sweptAxes(const Sweep& sweep) {
  std::vector<SweptAxis> swept = sweep.axes;
  for (const Variant& cell : sweep.also)
    for (const auto& [axis, value] : cell.values()) {
      auto found = std::ranges::find(swept, axis, &SweptAxis::axis);
      if (found == swept.end()) found = swept.insert(swept.end(), {axis, {}});
      if (std::ranges::find(found->values, value) == found->values.end()) found->values.push_back(value);
    }
  for (const SweptKernel& kernel : sweep.kernels) swept.push_back({"kernel:" + kernel.stage, kernel.texts});
  return swept;
}

std::vector<Labels> combinations(const Sweep& sweep) {
  std::vector<SweptAxis> product = sweep.axes;
  for (const SweptKernel& kernel : sweep.kernels) product.push_back({"kernel:" + kernel.stage, kernel.texts});
  std::vector<Labels> all{sweep.set.values()};
  for (const SweptAxis& axis : product) {
    std::vector<Labels> more;
    for (const Labels& labels : all)
      for (const std::string& value : axis.values) more.emplace_back(labels)[axis.axis] = value;
    all = std::move(more);
  }
  std::erase_if(all, [&](const Labels& labels) {
    return std::ranges::any_of(sweep.leaveOut, [&](const LeaveOut& out) {
      return std::ranges::all_of(out, [&](const auto& axis) {
        return std::ranges::find(axis.second, labels.at(axis.first)) != axis.second.end();
      });
    });
  });
  for (const Variant& cell : sweep.also) {
    Labels labels = sweep.set.values();
    for (const auto& [axis, value] : cell.values()) labels[axis] = value;
    for (const SweptKernel& kernel : sweep.kernels) labels["kernel:" + kernel.stage] = "";
    all.push_back(std::move(labels));
  }
  return all;
}

}  // namespace tessera::harness
