#include "host/cli/common.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "datasets/input.h"
#include "host/cpu/cpu-device.h"
#include "host/error.h"
#include "host/files.h"
#include "host/stages.h"
#include "host/user-kernel.h"
#include "host/vulkan/vulkan-device.h"

namespace tessera::cli {
namespace {

namespace fs = std::filesystem;

struct Size {
  std::uint32_t width, height;
};

Size parseSize(const std::string& text) {
  Size size{};
  const char* const end = text.data() + text.size();
  const auto [cross, first] = std::from_chars(text.data(), end, size.width);
  bool good = first == std::errc{} && cross != end && *cross == 'x';
  if (good) {
    const auto [rest, second] = std::from_chars(cross + 1, end, size.height);
    good = second == std::errc{} && rest == end;
  }
  const auto inRange = [](std::uint32_t extent) { return extent >= 1 && extent <= kMaxExtent; };
  if (!good || !inRange(size.width) || !inRange(size.height))
    failUsage(
        fmt::format("--size {}: not a raster size; WIDTHxHEIGHT with 1 to {} pixels each, e.g. 2048x1024, would be",
                    text, kMaxExtent));
  return size;
}

ValueRange parseRange(const std::string& text) {
  ValueRange range;
  const char* const end = text.data() + text.size();
  const auto [comma, first] = std::from_chars(text.data(), end, range.least);
  bool good = first == std::errc{} && comma != end && *comma == ',';
  if (good) {
    const auto [rest, second] = std::from_chars(comma + 1, end, range.most);
    good = second == std::errc{} && rest == end;
  }
  if (!good || !std::isfinite(range.least) || !std::isfinite(range.most) || range.least == range.most)
    failUsage(fmt::format("--range {}: not a range; two different numbers, e.g. -1,2.5, would be", text));
  return range;
}

}  // namespace

void addInput(CLI::App& app, Options& options) {
  app.add_option("INPUT", options.input,
                 "a mesh (.obj .off .ply .stl), a generator, a scene (.toml) or a replay file (.replay)")
      ->required();
  app.add_option("--size", options.size, "raster size in pixels; the scene's own if not given")->type_name("WxH");
}

void addSettings(CLI::App& app, Options& options) {
  app.add_option("--set", options.settings, "fix one axis; repeat for more; what is not set is the plan's choice")
      ->type_name("AXIS=VALUE")
      ->allow_extra_args(false);
}

void addKernelFiles(CLI::App& app, Options& options) {
  app.add_option(
         "--kernel", options.kernels,
         "run FILE (.slang, .hlsl, or GLSL as .comp or .glsl) in place of a stage's own kernel; repeat for more")
      ->type_name("STAGE=FILE")
      ->allow_extra_args(false);
}

void addAttribute(CLI::App& app, Options& options) {
  auto* const attribute =
      app.add_option("--attribute", options.attribute,
                     "a raster of values: x, y or z, or a scalar property of a PLY file's vertices, over each triangle")
          ->type_name("NAME");
  app.add_option(
         "--range", options.range,
         "what the attribute spans in pictures and relative errors; integer properties of 0 to 32767 are mapped "
         "to it")
      ->type_name("A,B")
      ->needs(attribute);
}

void addThreads(CLI::App& app, Options& options) {
  app.add_option("--threads", options.threads, "threads of the CPU device; all cores if not given")
      ->type_name("N")
      ->check(CLI::Range(1, 4096));
}

void addRepeat(CLI::App& app, unsigned& repeat) {
  app.add_option("--repeat", repeat, "time N frames, after one that warms up")
      ->type_name("N")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
}

void addDevice(CLI::App& app, Options& options, bool many) {
  const auto* const text = "cpu, vulkan, vulkan:N (its number in 'tessera devices') or vulkan:NAME (part of its name)";
  auto* const option = app.add_option("--device", options.devices, text)->type_name("DEVICE")->allow_extra_args(false);
  if (!many) option->expected(1);
}

Variant variantOf(const Options& options) {
  Variant variant;
  for (const auto& setting : options.settings) {
    const std::string name = setting.substr(0, setting.find('='));
    if (variant.has(name)) failUsage(fmt::format("--set {}: {} is set twice; once would do", setting, name));
    variant.set(setting);
  }
  return variant;
}

KernelFiles kernelFilesOf(const Options& options) {
  KernelFiles files;
  for (const std::string& text : options.kernels) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) failUsage(fmt::format("--kernel {}: takes STAGE=FILE", text));
    const std::string stage = text.substr(0, equals);
    const fs::path file = text.substr(equals + 1);
    if (std::ranges::find(stages(), stage, &Stage::name) == stages().end()) {
      std::vector<std::string> names;
      for (const Stage& s : stages()) names.push_back(s.name);
      failUsage(fmt::format("--kernel {}: no such stage; there are {}", text, fmt::join(names, ", ")));
    }
    std::error_code ignored;
    if (!fs::is_regular_file(file, ignored)) failUsage(fmt::format("--kernel {}: no such file", text));
    languageOf(file);
    if (!files.emplace(stage, file).second) failUsage(fmt::format("--kernel {}: the stage has a file already", text));
  }
  return files;
}

AttributeRequest attributeOf(const Options& options) {
  AttributeRequest request{options.attribute, {}};
  if (!options.range.empty()) request.range = parseRange(options.range);
  return request;
}

Scene sceneOf(const Options& options) {
  const Size size = options.size.empty() ? Size{0, 0} : parseSize(options.size);  // 0: the scene's own
  return loadInput(options.input, size.width, size.height, attributeOf(options));
}

std::unique_ptr<Device> openDevice(const std::string& name, unsigned threads) {
  if (name == "cpu") return makeCpuDevice({.threads = threads});
  VulkanOptions vulkan;
  if (name.starts_with("vulkan:")) vulkan.select = name.substr(7);
  if (name != "vulkan" && vulkan.select.empty())
    failUsage(fmt::format("--device {}: no such device; cpu, vulkan, vulkan:N or vulkan:NAME would be", name));
#ifdef TESSERA_VALIDATION
  vulkan.validation = true;
#endif
  return makeVulkanDevice(vulkan);
}

std::unique_ptr<Device> openDevice(const Options& options) {
  const std::string name = options.devices.empty() ? "cpu" : options.devices.front();
  if (options.threads != 0 && name.starts_with("vulkan"))
    failUsage("--threads: only the CPU device takes it; --device cpu would");
  return openDevice(name, options.threads);
}

std::vector<std::string> presentDevices() {
  std::vector<std::string> names{"cpu"};
  for (const auto& adapter : listVulkanAdapters().adapters)
    if (adapter.whyNot.empty()) names.push_back(fmt::format("vulkan:{}", adapter.index));
  return names;
}

Route routeOf(const DeviceInfo& device, const Variant& variant) {
  if (device.api == "cpu") return Route::kCpp;
  return variant.get("route", "spirv") == "glsl" ? Route::kGlsl : Route::kSpirv;
}

std::string axesHelp() {
  std::string text = "Axes for --set ('tessera variants' says more):\n";
  for (const auto& axis : axes()) {
    std::vector<std::string> values;
    for (const auto& value : axis.values) values.push_back(value.name);
    const std::string range =
        values.empty() ? fmt::format("{} to {}", axis.least, axis.most) : fmt::format("{}", fmt::join(values, ", "));
    text += fmt::format("  {:<14} {}\n", axis.name, range);
  }
  return text;
}

std::string inputHelp() {
  std::string text =
      "An installed mesh: INPUT is mesh:NAME, e.g. mesh:refined_elephant (Debian's libcgal-demo has it)\n"
      "Generators (INPUT is generate:NAME or generate:NAME?KEY=VALUE&KEY=VALUE):\n";
  for (const auto& doc : generatorDocs())
    text += fmt::format("  {:<10} {}\n  {:<10} {}\n", doc.name, doc.makes, "", doc.parameters);
  return text;
}

void checkOutputPath(const fs::path& path, const std::string& input) {
  if (path == "-") return;
  const fs::path folder = path.has_parent_path() ? path.parent_path() : ".";
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) failUsage(fmt::format("{}: is a folder; a file name would do", path.string()));
  if (!fs::is_directory(folder, ignored))
    failUsage(fmt::format("{}: the folder {} does not exist", path.string(), folder.string()));
  if (access(folder.c_str(), W_OK) != 0)
    failUsage(fmt::format("{}: the folder {} cannot be written", path.string(), folder.string()));
  if (fs::equivalent(path, input, ignored))
    failUsage(fmt::format("{}: is the input; another name would keep it", path.string()));
}

void writeText(const fs::path& path, const std::string& text) {
  if (path == "-") {
    std::fputs(text.c_str(), stdout);
    return;
  }
  if (!writeBeside(path, text)) fail(fmt::format("{}: could not be written", path.string()));
}

}  // namespace tessera::cli
