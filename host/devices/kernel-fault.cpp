#include "host/devices/kernel-fault.h"

#include <fmt/format.h>
#include <tessera/error.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstring>

namespace tessera::devices {
namespace {

std::atomic<const char*> running{nullptr};

void put(const char* text) {
  if (write(STDERR_FILENO, text, std::strlen(text)) < 0) return;  // nobody to tell
}

/// Only what a signal handler may call.
void onFault(int signal) {
  const char* const kernel = running.load();
  if (kernel == nullptr) {
    std::signal(signal, SIG_DFL);
    raise(signal);
    return;
  }
  put("tessera: ");
  put(kernel);
  put(signal == SIGFPE ? ": an integer division by zero, or one whose result does not fit\n"
                       : ": it reads or writes where no memory is\n");
  _exit(static_cast<int>(ExitCode::kUsage));
}

}  // namespace

std::string describe(const CompiledKernel& kernel, const std::string& api) {
  return kernel.file.empty() ? fmt::format("{}: kernel {}", api, kernel.stage)
                             : fmt::format("kernel {} ({})", kernel.stage, kernel.file.string());
}

void failOutOfBounds(const CompiledKernel& kernel, const std::string& api, std::int64_t index, std::uint64_t count,
                     const std::string& what) {
  throw Error(
      kernel.file.empty() ? ExitCode::kFailure : ExitCode::kUsage,
      fmt::format("{}: out of bounds: index {} of {} elements of {}", describe(kernel, api), index, count, what));
}

void sayKernelFaults() {
  struct sigaction action {};
  action.sa_handler = onFault;
  for (const int signal : {SIGFPE, SIGSEGV, SIGBUS, SIGILL}) sigaction(signal, &action, nullptr);
}

RunningKernel::RunningKernel(const char* description) { running = description; }
RunningKernel::~RunningKernel() { running = nullptr; }
const char* runningKernel() { return running; }

}  // namespace tessera::devices
