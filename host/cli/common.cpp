#include "host/cli/common.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tessera/error.h>
#include <tessera/input.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <set>

#include "datasets/input-files.h"
#include "datasets/text.h"
#include "host/axes/settings.h"
#include "host/devices/open.h"
#include "host/kernels/user-kernel.h"
#include "host/measure/measure.h"
#include "host/plan/stages.h"
#include "host/support/file-faults.h"
#include "host/support/files.h"
#include "host/support/progress.h"
#include "host/support/suggest.h"
#include "host/support/terminal.h"

namespace tessera::cli {
namespace {

namespace fs = std::filesystem;

struct Size {
  std::uint32_t width, height;
};

/// "1024", "1024x768", "1024X768".
Size parseSize(const std::string& text) {
  Size size{};
  const char* const end = text.data() + text.size();
  const auto [cross, first] = std::from_chars(text.data(), end, size.width);
  size.height = size.width;
  bool good = first == std::errc{};
  if (good && cross != end) {
    const auto [rest, second] = std::from_chars(cross + 1, end, size.height);
    good = (*cross == 'x' || *cross == 'X') && second == std::errc{} && rest == end;
  }
  const auto inRange = [](std::uint32_t extent) { return extent >= 1 && extent <= kMaxExtent; };
  if (!good || !inRange(size.width) || !inRange(size.height))
    failUsage(
        fmt::format("--size {}: not a raster size; WIDTHxHEIGHT, or one number for a square, of 1 to {} pixels each "
                    "would be right, "
                    "e.g. 2048x1024",
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
  if (!good || !std::isfinite(range.least) || !std::isfinite(range.most - range.least) || range.least == range.most)
    failUsage(fmt::format("--range {}: not a range; two different numbers, as float32 has them, e.g. -1,2.5, would be",
                          text));
  return range;
}

}  // namespace

void addInput(CLI::App& app, Options& options) {
  app.add_option("INPUT", options.input,
                 "a mesh (.obj .off .ply .stl), mesh:NAME, generate:NAME, a scene (.toml) or a replay file (.replay)")
      ->required();
  app.add_option(
         "--size", options.size,
         fmt::format("raster size in pixels, 1 to {} each, or one number for a square; if not given the scene's "
                     "own, 1024 x 1024 for a mesh",
                     kMaxExtent))
      ->type_name("WxH");
}

void addSettings(CLI::App& app, Options& options) {
  app.add_option(
         "--set", options.settings,
         "set an axis; more of them with commas between, or by more --set; what is not set is the plan's choice")
      ->type_name("AXIS=VALUE")
      ->allow_extra_args(false);
}

void addKernelFiles(CLI::App& app, Options& options) {
  app.add_option(
         "--kernel", options.kernels,
         "run FILE (.slang, .hlsl, or GLSL as .comp or .glsl) in place of a stage's own kernel; repeat for more. It is "
         "native code, with your rights; a frame with bounds checks comes first")
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
  addCount(app, "--threads", options.threads, 1, 4096, "threads of the CPU device; all cores if not given");
}

CLI::Option* addCount(CLI::App& app, const std::string& name, unsigned& count, unsigned least, unsigned most,
                      const std::string& text) {
  const auto check = [least, most](std::string& typed) -> std::string {
    unsigned number = 0;
    const char* const end = typed.data() + typed.size();
    const auto [rest, error] = std::from_chars(typed.data(), end, number);
    if (error == std::errc{} && rest == end && number >= least && number <= most) return "";
    return fmt::format("{} is no whole number from {} to {}", typed, least, most);
  };
  return app.add_option(name, count, fmt::format("{}, {} to {}", text, least, most))
      ->type_name("N")
      ->check(CLI::Validator(check, "", "whole number"));
}

void addRepeat(CLI::App& app, unsigned& repeat) {
  addCount(app, "--repeat", repeat, 1, 1000000, "frames to time, after one that warms up")->capture_default_str();
}

void addQuiet(CLI::App& app, bool& quiet) {
  app.add_flag_callback(
      "-q,--quiet",
      [&quiet] {
        quiet = true;
        support::Progress::silence();
      },
      "no progress and no summary; warnings and errors stay");
}

void addDevice(CLI::App& app, Options& options, bool many) {
  auto* const option = app.add_option("--device", options.devices, devices::deviceForms(true))
                           ->type_name("DEVICE")
                           ->allow_extra_args(false);
  if (!many) option->expected(1);
}

std::vector<std::string> typedSettings(const Options& options) {
  std::vector<std::string> settings;
  for (const std::string& typed : options.settings) {
    bool first = true;
    for (const std::string& part : partsOf(typed, "--set", "AXIS=VALUE,AXIS=VALUE")) {
      for (const std::string& setting : axes::settingsIn(part)) {
        if (!first && setting.find('=') == setting.npos)
          failUsage(
              fmt::format("--set {}: '{}' has no axis; AXIS=VALUE,AXIS=VALUE would be right, with one value an axis",
                          typed, setting));
        settings.push_back(setting);
        first = false;
      }
    }
  }
  return settings;
}

Variant variantOf(const Options& options) { return Variant(fmt::format("{}", fmt::join(typedSettings(options), " "))); }

KernelFiles kernelFilesOf(const Options& options) {
  KernelFiles files;
  for (const std::string& text : options.kernels) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) failUsage(fmt::format("--kernel {}: takes STAGE=FILE", text));
    const std::string stage = text.substr(0, equals);
    const fs::path file = text.substr(equals + 1);
    if (std::ranges::find(plan::stages(), stage, &plan::Stage::name) == plan::stages().end())
      failUsage(fmt::format("--kernel {}: no such stage; {}", text,
                            support::whatThereIs(stage, support::namesOf(plan::stages(), &plan::Stage::name))));
    if (const std::string why = support::whyNoFile(file); !why.empty())
      failUsage(fmt::format("--kernel {}: {}", text, why));
    kernels::languageOf(file);
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
  Scene scene = [&] {
    support::Progress progress(fmt::format("reading {}", options.input), 0);
    const auto start = std::chrono::steady_clock::now();
    return loadInput(
        options.input, size.width, size.height, attributeOf(options), [&](std::size_t done, std::size_t total) {
          constexpr double kMegabyte = 1e6;
          const auto here = static_cast<double>(done), all = static_cast<double>(total);
          const double passed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
          progress.at(0, fmt::format("{:.0f} of {:.0f} MB", here / kMegabyte, all / kMegabyte),
                      done == 0 ? std::nullopt : std::optional(passed / here * (all - here)));
        });
  }();
  measure::printNotes(scene);
  return scene;
}

std::string deviceName(const Options& options) {
  return options.devices.empty() ? devices::defaultDevice() : options.devices.front();
}

std::unique_ptr<Device> deviceOf(const Options& options) {
  const std::string name = deviceName(options);
  if (options.threads != 0 && !devices::kindOf(name).takesThreads) {
    std::vector<std::string> titles, names;
    for (const DeviceKind& kind : deviceKinds())
      if (kind.takesThreads) titles.push_back(kind.title), names.push_back(kind.name);
    failUsage(fmt::format("--threads: only the {} device takes it; --device {} would", fmt::join(titles, " or "),
                          fmt::join(names, " or ")));
  }
  return openDevice(name, {.threads = options.threads});
}

std::vector<std::string> partsOf(const std::string& typed, const std::string& option, const std::string& right) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= typed.size();) {
    const std::size_t end = std::min(typed.find(',', begin), typed.size());
    std::string part = typed.substr(begin, end - begin);
    part.erase(0, part.find_first_not_of(' '));
    part.erase(part.find_last_not_of(' ') + 1);
    if (part.empty())
      failUsage(fmt::format("{} {}: {}; {} would be right", option, quoted(typed),
                            typed.find(',') == typed.npos ? "nothing is there" : "nothing is on one side of a comma",
                            right));
    parts.push_back(std::move(part));
    begin = end + 1;
  }
  return parts;
}

std::vector<fs::path> inputsOf(const Options& options) {
  std::vector<fs::path> files = datasets::inputFiles(options.input);
  for (const std::string& text : options.kernels) files.emplace_back(text.substr(text.find('=') + 1));
  return files;
}

std::string quoted(const std::string& word) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./:=+,-";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

}  // namespace tessera::cli
