#include "experiments/harness/estimate.h"

#include <tessera/error.h>
#include <tessera/input.h>
#include <tessera/oracle.h>
#include <tessera/rasterizer.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>

#include "host/devices/open.h"
#include "host/measure/kernel-check.h"
#include "host/measure/measure.h"
#include "host/oracle/oracle-image.h"
#include "host/support/file-faults.h"
#include "host/support/progress.h"

namespace tessera::harness {
namespace {

using Json = nlohmann::json;

double secondsOf(const auto& action) {
  const auto start = std::chrono::steady_clock::now();
  action();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Times of cells in relation to their references, by scene, device and what the cells are made of.
class Ratios {
 public:
  /// Lines that are no rows of a sweep are passed over: any file may have that name, and so may a pipe.
  explicit Ratios(const std::filesystem::path& file) {
    if (!support::whyNoFile(file).empty()) return;
    std::ifstream stream(file);
    std::map<std::string, double> references;
    std::vector<std::pair<std::string, Json>> rows;
    for (std::string line; std::getline(stream, line);) {
      const Json row = Json::parse(line, nullptr, false);
      try {
        const double median = row.at("time_ns").at("median");
        const Json& sweep = row.at("sweep");
        const std::string group = Json{row.at("provenance").at("cpu"),
                                       row.at("provenance").at("device"),
                                       sweep.at("scene"),
                                       sweep.at("device"),
                                       sweep.at("threads"),
                                       row.at("scene").at("size")}
                                      .dump();
        if (sweep.at("reference") && median > 0) references[group] = median;
        rows.emplace_back(group, Json{keyOf(sweep.at("scene"), sweep.at("device"), sweep.at("asked")), median});
      } catch (const Json::exception&) {
      }
    }
    for (const auto& [group, row] : rows)
      if (const auto reference = references.find(group); reference != references.end())
        ratios_[row[0]].push_back(row[1].get<double>() / reference->second);
  }

  /// The middle one of those at all sizes and on all machines that the file has rows of.
  std::optional<double> of(const SweepScene& scene, const SweepPoint& cell) {
    const auto found = ratios_.find(keyOf(scene.name, cell.device, cell.labels));
    if (found == ratios_.end()) return {};
    std::ranges::sort(found->second);
    return found->second[found->second.size() / 2];
  }

 private:
  static std::string keyOf(const Json& scene, const Json& device, const Json& asked) {
    return Json{scene, device, asked}.dump();
  }

  std::map<std::string, std::vector<double>> ratios_;
};

/// What one group's reference takes, in seconds.
struct GroupTimes {
  double first = 0;      ///< a frame for which buffers and pipelines are made, and that is read back
  double frame = 0;      ///< a further one
  double attribute = 0;  ///< the error of its values from the exact ones
};

class Meter {
 public:
  Meter(const Sweep& sweep, const Survey& survey) : sweep_(sweep), uncompiled_(survey.uncompiled.size()) {}

  /// The scene as this cell needs it.
  const Scene& load(const SweepPoint& cell) {
    if (scene_ && loaded_->scene == cell.scene && loaded_->size == cell.size) return *scene_;
    const SweepScene& input = sweep_.scenes[cell.scene];
    loadingS_ +=
        secondsOf([&] { scene_ = loadInput(input.input, cell.size.width, cell.size.height, input.attribute); });
    loaded_ = &cell;
    return *scene_;
  }

  GroupTimes measure(const SweepPoint& cell) {
    const Scene& scene = load(cell);
    const auto device = openDevice(cell.device, {.threads = cell.threads});
    KernelCache kernels({.files = cell.kernels});
    compilingS_ += secondsOf([&] { measure::compileKernels(kernels, {makePlan(scene, cell.asked, device->info())}); });
    compiled_ += kernels.statistics().compiled;
    measure::checkUserKernels(scene, cell.kernels, {{cell.device, cell.asked}});
    Rasterizer rasterizer(*device, kernels);
    GroupTimes times;
    Frame frame;
    times.first = secondsOf([&] { frame = rasterizer.render(scene, cell.asked); });
    times.frame = secondsOf([&] { rasterizer.render(scene, cell.asked, {.readBack = false}); });
    if (scene.attribute() != nullptr)
      times.attribute =
          secondsOf([&] { oracle::attributeError(scene, oracle::imageAxesOf(frame.plan.resolved), frame.image); });
    return times;
  }

  /// One of the oracle's images at this scene and size; measured once.
  double oracle(const SweepPoint& cell) {
    const auto [entry, isNew] = oracles_.try_emplace({cell.scene, cell.size.width, cell.size.height});
    if (isNew) entry->second = secondsOf([&] { oracle::render(load(cell), oracle::imageAxesOf(cell.asked)); });
    return entry->second;
  }

  double loadingS() const { return loadingS_; }
  /// Kernels that are left to compile; of them the seconds, if some were compiled here.
  std::size_t uncompiled() const { return uncompiled_ - std::min(uncompiled_, compiled_); }
  std::optional<double> compilingS() const {
    if (compiled_ == 0) return {};
    return compilingS_ / static_cast<double>(compiled_) * static_cast<double>(uncompiled());
  }

 private:
  const Sweep& sweep_;
  std::optional<Scene> scene_;
  const SweepPoint* loaded_ = nullptr;
  double loadingS_ = 0, compilingS_ = 0;
  std::size_t uncompiled_, compiled_ = 0;
  std::map<std::tuple<std::size_t, std::uint32_t, std::uint32_t>, double> oracles_;
};

}  // namespace

Estimate estimate(const Sweep& sweep, const std::vector<SweepPoint>& cells, const Survey& survey) {
  Ratios ratios(sweep.path.parent_path() / "results.jsonl");
  Meter meter(sweep, survey);
  Estimate result;
  const double frames = 2 + static_cast<double>(sweep.rounds) * (sweep.warmUp + sweep.repeats);
  const auto addGroup = [&](const std::vector<const SweepPoint*>& run, const GroupTimes& times, double oracle) {
    std::set<std::string> images;
    for (const SweepPoint* const cell : run) {
      std::optional<double> ratio;
      if (!cell->reference && !cell->twin) {
        ratio = ratios.of(sweep.scenes[cell->scene], *cell);
        ++result.others;
        result.fromRows += ratio.has_value();
      }
      const std::set<std::string>& own = survey.cells[cell->number].images;
      images.insert(own.begin(), own.end());
      const double frame = std::min(sweep.timeLimitS, times.frame * ratio.value_or(1));
      result.seconds += times.first + times.attribute + frames * frame;
    }
    result.nothing = false;
    result.seconds += static_cast<double>(images.size()) * oracle;
  };
  support::Progress progress("measuring the references", cells.empty() ? 0 : cells.back().group + 1);
  for (auto first = cells.begin(); first != cells.end();) {
    const auto last =
        std::find_if(first, cells.end(), [&](const SweepPoint& cell) { return cell.group != first->group; });
    std::vector<const SweepPoint*> run;
    for (auto cell = first; cell != last; ++cell)
      if (!survey.cells[cell->number].refused) run.push_back(&*cell);
    first = last;
    if (run.empty()) continue;
    const auto reference = std::ranges::find_if(run, &SweepPoint::reference);
    const SweepPoint& measured = reference == run.end() ? *run.front() : **reference;
    progress.at(measured.group, cellName(sweep, measured));
    try {
      const GroupTimes times = meter.measure(measured);
      addGroup(run, times, meter.oracle(measured));
    } catch (const Error& error) {
      result.unmeasured += run.size();
      result.whyNot = error.what();
    }
  }
  result.uncompiled = meter.uncompiled();
  const auto compiling = meter.compilingS();
  result.compilingIsCounted = result.uncompiled == 0 || compiling.has_value();
  result.seconds += meter.loadingS() + compiling.value_or(0);
  return result;
}

}  // namespace tessera::harness
