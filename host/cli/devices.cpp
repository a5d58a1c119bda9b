// tessera devices: what can run here, what it can do, and whether its arithmetic gives the contract's bits.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tessera/kernel-cache.h>

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "host/axes/routes.h"
#include "host/cli/commands.h"
#include "host/cli/common.h"
#include "host/devices/open.h"
#include "host/measure/probe-text.h"
#include "host/support/progress.h"
#include "host/support/table.h"
#include "host/support/terminal.h"

namespace tessera::cli {
namespace {

using Json = nlohmann::ordered_json;
using Rows = std::vector<std::vector<std::string>>;

/// One probe a route. A device whose probe cannot run at all is still listed.
std::string probeCell(Device& device, KernelCache* kernels, Route route, std::string& notes, const std::string& name) {
  if (!kernels) return "not run";
  try {
    const Probe probe = probeDevice(device, *kernels, route);
    for (const auto& result : probe.results)
      if (!result.passed || !result.required)
        notes += fmt::format("{} ({}): {} {}{}\n", name, measure::routeName(route), result.name,
                             result.passed     ? ""
                             : result.required ? "FAILED: "
                                               : "differs: ",
                             result.detail);
    return measure::verdictOf(probe);
  } catch (const Error& error) {
    notes += fmt::format("{} ({}): the probe could not run: {}\n", name, measure::routeName(route), error.what());
    return "could not run";
  }
}

std::string yesNo(bool value) { return value ? "yes" : "no"; }

std::string limitText(std::uint32_t limit) { return limit == ~0u ? "any" : support::grouped(limit); }

/// Absent where nothing is known to limit it.
Json limitJson(std::uint64_t limit, std::uint64_t none) { return limit == none ? Json() : Json(limit); }

void addDeviceRow(Rows& rows, Json& json, const std::string& name, KernelCache* kernels, std::string& notes) {
  const auto device = openDevice(name);
  const DeviceInfo& info = device->info();
  Json probes;
  std::vector<std::string> cells;
  for (const std::string& route : info.routes) {
    const std::string verdict = probeCell(*device, kernels, axes::routeNamed(route).route, notes, name);
    probes[route] = verdict;
    cells.push_back(info.routes.size() == 1 ? verdict : route + " " + verdict);
  }
  json.push_back({{"device", name},
                  {"name", info.name},
                  {"driver", info.driver},
                  {"software", info.correctnessOnly},
                  {"threads", info.threads != 0 ? Json(info.threads) : Json()},
                  {"int64", info.int64},
                  {"float64", info.float64},
                  {"atomic64", info.atomicMin64},
                  {"buffer_bytes", limitJson(info.maxBufferBytes, ~0ull)},
                  {"group_bytes", info.maxGroupBytes},
                  {"loop", limitJson(info.maxLoopIterations, ~0u)},
                  {"groups", limitJson(info.maxGroupsPerDimension, ~0u)},
                  {"clock", info.timeClock},
                  {"probe", probes}});
  rows.push_back({name, info.name, info.driver, yesNo(info.int64), yesNo(info.atomicMin64),
                  support::byteSize(info.maxBufferBytes), support::byteSize(info.maxGroupBytes),
                  limitText(info.maxLoopIterations), limitText(info.maxGroupsPerDimension), info.timeClock,
                  fmt::format("{}", fmt::join(cells, ", "))});
  if (info.correctnessOnly) notes += fmt::format("{}: a software driver; its times say nothing about a GPU\n", name);
}

struct DevicesOptions {
  bool json = false, quiet = false;
};

ExitCode runDevices(const DevicesOptions& options) {
  Json json{{"devices", Json::array()}, {"unusable", Json::array()}, {"slangc", Json()}, {"kernels", Json()}};
  std::unique_ptr<KernelCache> kernels;
  std::string compilers;
  try {
    kernels = std::make_unique<KernelCache>();
    const ToolInfo& slangc = kernels->slangc();
    json["slangc"] = {{"version", slangc.version}, {"path", slangc.path.string()}, {"origin", slangc.origin}};
    json["kernels"] = kernels->folder().string();
    compilers = fmt::format("slangc   {} {} (from {})\nC++      {}\nkernels  {}\n", slangc.version,
                            slangc.path.string(), slangc.origin, kernels->cxx(), kernels->folder().string());
  } catch (const Error& error) {
    kernels.reset();
    compilers = fmt::format("no kernel can be compiled here: {}\n", error.what());
  }
  Rows rows{
      {"device", "name", "driver", "int64", "atomic64", "buffer", "group memory", "loop", "groups", "clock", "probe"}};
  std::string notes;
  const auto names = devices::presentDevices();
  {
    support::Progress progress("devices", names.size());
    for (std::size_t i = 0; i < names.size(); ++i) {
      progress.at(i, names[i]);
      addDeviceRow(rows, json["devices"], names[i], kernels.get(), notes);
    }
  }
  Json ofDrivers = Json::array();
  for (const DeviceKind& kind : deviceKinds()) {
    const FoundDevices found = kind.find();
    for (const FoundDevice& device : found.devices)
      if (!device.whyNot.empty()) {
        const std::string name = devices::nameOf(kind, device);
        json["unusable"].push_back(
            {{"device", name}, {"name", device.name}, {"driver", device.driver}, {"why", device.whyNot}});
        notes += fmt::format("{} {} ({}): cannot be used: {}\n", name, device.name, device.driver, device.whyNot);
      }
    for (const auto& note : found.notes) {
      ofDrivers.push_back(note);
      notes += fmt::format("{}: {}\n", kind.name, note);
    }
  }
  if (options.json) {
    json["notes"] = ofDrivers;
    support::say(stdout, "{}\n", json.dump(2, ' ', false, Json::error_handler_t::replace));
    return ExitCode::kDone;
  }
  support::say(stdout, "{}\n{}{}{}", support::table(rows), notes, notes.empty() ? "" : "\n", compilers);
  return ExitCode::kDone;
}

}  // namespace

Command addDevices(CLI::App& app) {
  auto options = std::make_shared<DevicesOptions>();
  auto* const command =
      app.add_subcommand("devices", "list the devices here, their limits and the verdict of the arithmetic probe");
  command->add_flag("--json", options->json, "print JSON; null is no limit");
  addQuiet(*command, options->quiet);
  command->footer(
      "buffer: largest storage buffer; loop: iterations that one invocation can run; groups: workgroups in a "
      "dimension. "
      "Parity of images is claimed where the probe passes, and where it finds denormals flushed to zero and nothing "
      "else, for scenes whose arithmetic meets none.");
  return {command, [options] { return runDevices(*options); }};
}

}  // namespace tessera::cli
