#include "experiments/harness/worker.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <iostream>
#include <map>
#include <new>
#include <set>

#include "experiments/harness/check.h"
#include "experiments/harness/fields.h"
#include "experiments/harness/request.h"
#include "experiments/harness/watchdog.h"
#include "host/axes/routes.h"
#include "host/axes/settings.h"
#include "host/devices/open.h"
#include "host/measure/measure.h"
#include "host/plan/stages.h"

namespace tessera::harness {
namespace {

/// Graphics drivers compile a pipeline when it is first drawn with, for minutes where they are software.
constexpr double kFirstFrames = 10;

/// One write a message: the watchdog's thread writes, too.
void send(int out, const Json& message) {
  const std::string line = lineOf(message);
  std::string_view rest = line;
  while (!rest.empty()) {
    const ssize_t put = write(out, rest.data(), rest.size());
    if (put < 0 && errno == EINTR) continue;
    if (put <= 0) _exit(1);  // nobody listens
    rest.remove_prefix(static_cast<std::size_t>(put));
  }
}

Json ended(const std::string& status, const std::string& message) {
  return {{"event", "ended"}, {"status", status}, {"message", message}};
}

/// And the clock that its times will be by, which rows have beside times only.
Json rowJson(const measure::Run& run) {
  Json row = Json::parse(measure::rowText(run));
  row["clock"] = run.device.timeClock;
  return row;
}

class Worker {
 public:
  Worker(WorkerJob job, int out)
      : job_(std::move(job)), out_(out), watchdog_(job_.timeLimitS, [this](double limitS) {
          send(out_, ended("timeout", fmt::format("a frame took longer than {:g} s", limitS)));
          _exit(0);
        }) {
    for (const auto& cell : job_.cells) cells_[cell.number] = &cell;
  }

  /// Scenes, devices, kernels. Throws Error where the job as a whole cannot be done.
  void prepare() {
    std::map<KernelFiles, std::vector<Plan>> plans;
    for (const auto& cell : job_.cells) {
      const Scene& scene = sceneOf(cell);
      Device& device = deviceOf(cell);
      KernelCache& kernels = kernelsOf(cell);
      measure::Run run = beginOf(cell, device, kernels);
      std::string refused;
      try {
        for (const bool work : {false, true}) {
          Plan plan = makePlan(scene, work ? axes::counting(cell.asked) : cell.asked, run.device);
          if (!work) run.variant = plan.resolved;
          if (!work) run.plan = plan.entries;
          plan::kernelRequests(plan, cell.kernels);
          plans[cell.kernels].push_back(std::move(plan));
        }
      } catch (const Error& error) {  // the check says so
        refused = error.what();
      }
      Json message{{"event", "planned"}, {"cell", cell.number}, {"row", rowJson(run)}};
      if (!refused.empty()) message["refused"] = refused;
      send(out_, message);
    }
    for (const auto& [files, list] : plans) {
      try {
        measure::compileKernels(*kernels_.at(files), list);
      } catch (const Error&) {  // a user's kernel, or one of ours: the check of each cell that takes it says so
      }
    }
  }

  void serve(const Json& request) {
    const auto found = cells_.find(wholeAt<std::uint32_t>(request, "cell"));
    if (found == cells_.end()) failField("cell", &member(request, "cell"), "one of the job's cells");
    if (textAt(request, "do") == "check")
      check(*found->second);
    else
      time(*found->second, flagAt(request, "warm"));
  }

 private:
  const Scene& sceneOf(const WorkerPoint& cell) {
    const auto [place, isNew] = scenes_.try_emplace({cell.size.width, cell.size.height});
    if (isNew) {
      place->second = loadInput(job_.input, cell.size.width, cell.size.height, job_.attribute);
      measure::printNotes(place->second);
    }
    return place->second;
  }

  Device& deviceOf(const WorkerPoint& cell) {
    auto& device = devices_[cell.threads];
    if (!device) device = openDevice(job_.device, {.threads = cell.threads});
    return *device;
  }

  KernelCache& kernelsOf(const WorkerPoint& cell) {
    auto& kernels = kernels_[cell.kernels];
    if (!kernels) kernels = std::make_unique<KernelCache>(KernelCache::Options{.files = cell.kernels});
    return *kernels;
  }

  Rasterizer& rasterizerOf(const WorkerPoint& cell) {
    auto& rasterizer = rasterizers_[{cell.threads, cell.kernels}];
    if (!rasterizer) rasterizer = std::make_unique<Rasterizer>(deviceOf(cell), kernelsOf(cell));
    return *rasterizer;
  }

  measure::Run beginOf(const WorkerPoint& cell, const Device& device, const KernelCache& kernels) {
    measure::Run run = measure::beginRun(sceneOf(cell), cell.asked, device, kernels);
    run.attributeRange = job_.attribute.range;
    run.truth = job_.truth;
    run.seed = job_.seed;
    return run;
  }

  double limit(const Device& device, bool first) const {
    const bool compiles = axes::routeNamed(device.info().routes.front()).spirv;  // its driver does, in the first frame
    return first && compiles ? kFirstFrames * job_.timeLimitS : job_.timeLimitS;
  }

  void check(const WorkerPoint& cell) {
    const auto device = openDevice(job_.device, {.threads = cell.threads});
    KernelCache& kernels = kernelsOf(cell);
    measure::Run run = beginOf(cell, *device, kernels);
    double seconds = 0;
    const auto under = [&](const std::function<void()>& frame) {
      const Watchdog::Watch watch(watchdog_, limit(*device, true));
      frame();
    };
    try {
      seconds = checkCell(run, cell.number, {*device, job_.device, kernels, oracles_, job_.folder, under});
    } catch (const Error& error) {
      run.status = measure::statusOf(error.code());
      run.message = error.what();
    } catch (const std::bad_alloc&) {
      run.status = "error";
      run.message = "out of memory";
    }
    resolved_[cell.number] = run.variant;
    send(out_, {{"event", "checked"}, {"cell", cell.number}, {"row", rowJson(run)}, {"frame_s", seconds}});
  }

  /// One timed frame, and with `warm` those that warm up before it.
  void time(const WorkerPoint& cell, bool warm) try {
    const Scene& scene = sceneOf(cell);
    Device& device = deviceOf(cell);
    Rasterizer& rasterizer = rasterizerOf(cell);
    const auto known = resolved_.find(cell.number);
    const Variant resolved =
        known != resolved_.end() ? known->second : makePlan(scene, cell.asked, device.info()).resolved;
    const bool varies = variesFromRunToRun(resolved);
    const auto render = [&](bool readBack) {
      const Watchdog::Watch watch(watchdog_, limit(device, drawn_.insert(cell.number).second));
      return rasterizer.render(scene, cell.asked, {.readBack = readBack});
    };
    // Reading a frame back and comparing it cools the caches, so that the next one warms up again.
    for (unsigned i = 0; (warm || varies) && i < job_.warmUp; ++i) render(false);
    const Frame frame = render(varies);  // its time ends before it is read back
    Json stages = Json::object();
    for (const auto& [stage, ns] : frame.times.stages) stages[stage] = ns;
    Json sample{{"event", "sample"}, {"total_ns", frame.times.totalNs}, {"stages", std::move(stages)}};
    if (varies) sample["error"] = Json::parse(measure::differenceText(errorOf(scene, resolved, frame.image, oracles_)));
    send(out_, sample);
  } catch (const Error& error) {
    send(out_, ended(measure::statusOf(error.code()), error.what()));
  } catch (const std::bad_alloc&) {
    send(out_, ended("error", "out of memory"));
  }

  const WorkerJob job_;
  const int out_;
  std::map<std::size_t, const WorkerPoint*> cells_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, Scene> scenes_;
  std::map<unsigned, std::unique_ptr<Device>> devices_;  // by threads: frames that are timed
  std::map<KernelFiles, std::unique_ptr<KernelCache>> kernels_;
  std::map<std::pair<unsigned, KernelFiles>, std::unique_ptr<Rasterizer>> rasterizers_;  // after what they use
  std::map<std::size_t, Variant> resolved_;
  std::set<std::size_t> drawn_;  // cells that have had a frame on the device on which they are timed
  Oracles oracles_;
  Watchdog watchdog_;
};

}  // namespace

int serveWorker() {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  for (const int signal : {SIGINT, SIGTERM})
    std::signal(signal, SIG_IGN);                            // they reach the whole group: the parent decides
  const int out = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3);  // a compiler that outlives this process must not hold it
  dup2(STDERR_FILENO, STDOUT_FILENO);                        // a driver's chatter is no message
  const auto failed = [&](ExitCode code, const std::string& message) {
    send(out, {{"event", "failed"}, {"code", static_cast<int>(code)}, {"message", message}});
    return 0;
  };
  try {
    std::string line;
    if (!std::getline(std::cin, line)) return 0;
    Worker worker(jobOf(parsedLine(line)), out);
    worker.prepare();
    send(out, {{"event", "ready"}});
    while (std::getline(std::cin, line)) worker.serve(parsedLine(line));
    return 0;
  } catch (const Error& error) {
    return failed(error.code(), error.what());
  } catch (const std::bad_alloc&) {
    return failed(ExitCode::kFailure, "out of memory: a smaller size or scene would fit");
  } catch (const WrongField& wrong) {
    return failed(ExitCode::kFailure, std::string("sweep-worker: a message's ") + wrong.what());
  } catch (const std::exception& error) {
    return failed(ExitCode::kFailure, error.what());
  }
}

}  // namespace tessera::harness
