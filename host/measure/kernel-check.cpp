#include "host/measure/kernel-check.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tessera/cpu-device.h>
#include <tessera/error.h>
#include <tessera/plan.h>

#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <thread>

#include "host/devices/cpu/kernel-fault.h"
#include "host/kernels/user-kernel.h"
#include "host/measure/measure.h"
#include "host/plan/stages.h"
#include "host/support/terminal.h"

namespace tessera {
namespace {

constexpr auto kPatience = std::chrono::seconds(10);

/// What the CPU device takes of these; the rest is refused there or cannot run there at all, and its own device says
/// so.
KernelFiles runnable(const KernelFiles& files, const Plan& plan, const KernelCache::Options& options) {
  KernelFiles taken;
  for (const auto& [stage, file] : files) {
    try {
      KernelCache::Options alone = options;
      alone.files = {{stage, file}};
      KernelCache kernels(alone);
      compileStages(kernels, plan);
      taken.emplace(stage, file);
    } catch (const Error& error) {
      if (error.code() != ExitCode::kUnsupported) throw;
    }
  }
  return taken;
}

/// Says a line where the work is not done after a while: a kernel may never end.
class Patience {
 public:
  Patience()
      : thread_([this](std::stop_token) {
          std::unique_lock lock(mutex_);
          if (done_.wait_for(lock, kPatience, [&] { return ended_; })) return;
          const char* const kernel = runningKernel();
          say(stderr, "{} runs since {} s, with bounds checks; Ctrl-C stops it\n",
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
  Variant variant;
  KernelFiles files;
  std::unique_ptr<Device> device;
  std::unique_ptr<KernelCache> kernels;
};

KernelCheck::KernelCheck(const Scene& scene, const Variant& variant, const KernelFiles& files)
    : state_(new State{scene, variant, {}, makeCpuDevice(), nullptr}) {
  state_->variant.set("route", "cpp");
  try {
    const Plan plan = makePlan(scene, state_->variant, state_->device->info());
    KernelCache::Options options;
    options.boundsChecks = true;
    state_->files = runnable(files, plan, options);
    options.files = state_->files;
    state_->kernels = std::make_unique<KernelCache>(options);
    if (!state_->files.empty()) compileStages(*state_->kernels, plan);
  } catch (const Error& error) {
    if (error.code() != ExitCode::kUnsupported) throw;  // a variant for another device alone
    state_->files.clear();
  }
}

KernelCheck::~KernelCheck() = default;

void KernelCheck::run() {
  if (state_->files.empty()) return;
  const Patience patience;
  try {
    Rasterizer(*state_->device, *state_->kernels).render(state_->scene, state_->variant, {.readBack = false});
  } catch (const Error& error) {
    const std::string what = error.what();
    if (error.code() == ExitCode::kOverflow) return;  // the frame that counts says so
    if (error.code() != ExitCode::kFailure || what.find("out of bounds") == std::string::npos) throw;
    std::vector<std::string> users;
    for (const auto& [stage, file] : state_->files)
      users.push_back(fmt::format("kernel {} ({})", stage, file.string()));
    failUsage(fmt::format("{}; it runs on what {} wrote", what, fmt::join(users, ", ")));
  }
}

void checkUserKernels(const Scene& scene, const Variant& variant, const KernelFiles& files) {
  if (files.empty()) return;
  sayKernelFaults();
  KernelCheck(scene, variant, files).run();
}

}  // namespace tessera
