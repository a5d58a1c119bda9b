#include "host/devices/cpu/kernel-fault.h"

#include <tessera/error.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstring>

namespace tessera {
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

void sayKernelFaults() {
  struct sigaction action {};
  action.sa_handler = onFault;
  for (const int signal : {SIGFPE, SIGSEGV, SIGBUS, SIGILL}) sigaction(signal, &action, nullptr);
}

void setRunningKernel(const char* description) { running = description; }
const char* runningKernel() { return running; }

}  // namespace tessera
