#include "experiments/harness/survey.h"

#include <fmt/format.h>
#include <tessera/error.h>
#include <tessera/input.h>
#include <tessera/plan.h>

#include <map>
#include <tuple>

#include "host/axes/settings.h"
#include "host/devices/open.h"
#include "host/measure/measure.h"
#include "host/plan/stages.h"
#include "host/support/progress.h"

namespace tessera::harness {
namespace {

/// A device as it was asked for, or why it cannot be had.
struct Opened {
  std::unique_ptr<Device> device;
  std::string whyNot;
};

Opened open(const std::string& name, unsigned threads) {
  try {
    return {openDevice(name, {.threads = threads}), ""};
  } catch (const Error& error) {
    return {nullptr, error.what()};
  }
}

using KernelKey = std::tuple<std::string, std::filesystem::path, Route, VariantModules>;

}  // namespace

std::string imageText(const Variant& resolved) {
  std::string text;
  for (const Axis& axis : allAxes())
    if (axis.kind() == AxisKind::kImage) text += resolved.get(axis.name) + ' ';
  return text;
}

Survey survey(const Sweep& sweep, const std::vector<SweepPoint>& cells, KernelCache& kernels) {
  Survey survey;
  survey.cells.resize(cells.size());
  std::map<std::pair<std::string, unsigned>, Opened> devices;
  std::map<KernelKey, KernelRequest> needed;
  std::optional<Scene> scene;
  std::size_t loaded = 0;
  Size size;
  support::Progress progress("planning", cells.size());
  for (const SweepPoint& cell : cells) {
    SurveyedPoint& result = survey.cells[cell.number];
    const auto key = std::pair(cell.device, cell.threads);
    if (!devices.contains(key)) devices[key] = open(cell.device, cell.threads);
    const Opened& opened = devices[key];
    if (!opened.device) {
      result = {opened.whyNot, false, {}};
      continue;
    }
    if (!scene || loaded != cell.scene || size != cell.size) {
      const SweepScene& input = sweep.scenes[cell.scene];
      progress.at(cell.number, "loading " + input.name);
      scene = loadInput(input.input, cell.size.width, cell.size.height, input.attribute);
      measure::printNotes(*scene);
      loaded = cell.scene;
      size = cell.size;
    }
    progress.at(cell.number);
    try {
      const Plan plan = makePlan(*scene, cell.asked, opened.device->info());
      result.images = {imageText(plan.resolved)};
      if (!sweep.truth.values().empty()) result.images.insert(imageText(axes::joined(plan.resolved, sweep.truth)));
      for (const Plan& one : {plan, makePlan(*scene, axes::counting(cell.asked), opened.device->info())})
        for (const KernelRequest& request : plan::kernelRequests(one, cell.kernels))
          needed.try_emplace({request.stage, request.file, request.route, request.modules}, request);
    } catch (const Error& error) {
      if (error.code() != ExitCode::kUsage && error.code() != ExitCode::kUnsupported) throw;
      result.refused = error.what();
    }
  }
  survey.kernels = needed.size();
  for (const auto& [key, request] : needed)
    if (!kernels.has(request)) survey.uncompiled.push_back(request);
  return survey;
}

}  // namespace tessera::harness
