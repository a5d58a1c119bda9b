#include "host/measure/kernel-check.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tessera/error.h>
#include <tessera/plan.h>

#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <thread>
#include <utility>

#include "host/axes/routes.h"
#include "host/devices/kernel-fault.h"
#include "host/devices/open.h"
#include "host/kernels/user-kernel.h"
#include "host/plan/stages.h"
#include "host/support/terminal.h"

namespace tessera::measure {
namespace {

constexpr auto kPatience = std::chrono::seconds(10);

/// What a device with compiled checks takes of these; the rest is refused there or cannot run there at all, and its own
/// device says so.
KernelFiles runnable(const KernelFiles& files, const Plan& plan, const KernelCache::Options& options) {
  KernelFiles taken;
  for (const auto& [stage, file] : files) {
    try {
      KernelCache::Options alone = options;
      alone.files = {{stage, file}};
      KernelCache kernels(alone);
      plan::compileStages(kernels, plan);
      taken.emplace(stage, file);
    } catch (const Error& error) {
      if (error.code() != ExitCode::kUnsupported) throw;
    }
  }
  return taken;
}

/// The first kind of devices that takes a route with compiled checks, and that route; null where no kind does.
std::pair<const DeviceKind*, std::string> compiledChecks() {
  for (const DeviceKind& kind : deviceKinds())
    for (const std::string& route : kind.routes)
      if (axes::routeNamed(route).compiledChecks) return {&kind, route};
  return {nullptr, ""};
}

/// Says a line where the work is not done after a while: a kernel may never end.
class Patience {
 public:
  Patience()
      : thread_([this](std::stop_token) {
          std::unique_lock lock(mutex_);
          if (done_.wait_for(lock, kPatience, [&] { return ended_; })) return;
          const char* const kernel = devices::runningKernel();
          support::say(stderr, "{} runs since {} s, with bounds checks; Ctrl-C stops it\n",
                       kernel != nullptr ? kernel : "the checked frame", kPatience.count());
        }) {}
  ~Patience() {
    const std::lock_guard lock(mutex_);
    ended_ = true;
    done_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable done_;
  bool ended_ = false;
  std::jthread thread_;  // after what it uses
};

}  // namespace

struct KernelCheck::State {
  const Scene& scene;
  struct Checked {
    Variant variant;
    KernelFiles files;
    std::unique_ptr<Device> device;
    std::unique_ptr<KernelCache> kernels;
  };
  std::vector<Checked> all;

  /// On a device of this kind by this route, where the checks are compiled into the kernels.
  void addCompiled(const std::string& kind, const std::string& route, Variant variant, const KernelFiles& files) {
    variant.set("route", route);
    std::unique_ptr<Device> device = openDevice(kind);
    const Plan plan = makePlan(scene, variant, device->info());
    KernelCache::Options options;
    options.boundsChecks = true;
    options.files = runnable(files, plan, options);
    if (options.files.empty()) return;
    auto kernels = std::make_unique<KernelCache>(options);
    plan::compileStages(*kernels, plan);
    all.push_back({std::move(variant), options.files, std::move(device), std::move(kernels)});
  }

  /// On a device that puts the checks into the kernels as they are.
  void addChecking(const KernelRun& run, const KernelFiles& files) {
    std::unique_ptr<Device> device = openDevice(run.device, {.boundsChecks = true});
    auto kernels = std::make_unique<KernelCache>(KernelCache::Options{.files = files});
    plan::compileStages(*kernels, makePlan(scene, run.variant, device->info()));
    all.push_back({run.variant, files, std::move(device), std::move(kernels)});
  }

  void render(const Checked& checked) const {
    const Patience patience;
    try {
      Rasterizer(*checked.device, *checked.kernels).render(scene, checked.variant, {.readBack = false});
    } catch (const Error& error) {
      const std::string what = error.what();
      // The frame that counts says so.
      if (error.code() == ExitCode::kOverflow || error.code() == ExitCode::kUnsupported) return;
      if (error.code() != ExitCode::kFailure || what.find("out of bounds") == std::string::npos) throw;
      std::vector<std::string> users;
      for (const auto& [stage, file] : checked.files)
        users.push_back(fmt::format("kernel {} ({})", stage, file.string()));
      failUsage(fmt::format("{}; it runs on what {} wrote", what, fmt::join(users, ", ")));
    }
  }
};

KernelCheck::KernelCheck(const Scene& scene, const KernelFiles& files, const std::vector<KernelRun>& runs)
    : state_(new State{scene, {}}) {
  const auto add = [](const auto& what) {
    try {
      what();
    } catch (const Error& error) {
      if (error.code() != ExitCode::kUnsupported) throw;  // a variant for another device alone
    }
  };
  if (const auto [kind, route] = compiledChecks(); kind != nullptr)
    add([&] { state_->addCompiled(kind->name, route, runs.front().variant, files); });
  for (const KernelRun& run : runs)
    if (devices::kindOf(run.device).checksBounds) add([&] { state_->addChecking(run, files); });
}

KernelCheck::~KernelCheck() = default;

void KernelCheck::run(const std::function<void(const std::function<void()>&)>& frame) {
  for (const State::Checked& checked : state_->all) frame([&] { state_->render(checked); });
}

void checkUserKernels(const Scene& scene, const KernelFiles& files, const std::vector<KernelRun>& runs) {
  if (files.empty()) return;
  devices::sayKernelFaults();
  KernelCheck(scene, files, runs).run([](const auto& render) { render(); });
}

}  // namespace tessera::measure
