#include "experiments/harness/worker-process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <tessera/error.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

#include "experiments/harness/fields.h"
#include "host/support/progress.h"

extern char** environ;

namespace tessera::harness {
namespace {

int signalled = -1;  // the end that the handler writes to

extern "C" void tellInterrupt(int) {
  const int error = errno;
  [[maybe_unused]] const ssize_t put = write(signalled, "", 1);  // a full pipe has said enough
  errno = error;
}

void handle(int number, void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigaction(number, &action, nullptr);
}

void closeBoth(const int (&ends)[2]) {
  for (const int end : ends)
    if (end >= 0) close(end);
}

}  // namespace

Interrupts::Interrupts() {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC | O_NONBLOCK) != 0)
    fail(fmt::format("sweep: signals cannot be waited for: {}", std::strerror(errno)));
  descriptor_ = ends[0];
  signalled = ends[1];
  // A handler, not a mask with a signalfd: libraries have made threads already, which would not have the mask.
  handle(SIGINT, tellInterrupt);
  handle(SIGTERM, tellInterrupt);
  std::signal(SIGPIPE, SIG_IGN);  // a worker that died is seen by what it says
}

Interrupts::~Interrupts() {
  handle(SIGINT, SIG_DFL);
  handle(SIGTERM, SIG_DFL);
  close(descriptor_);
  close(std::exchange(signalled, -1));
}

bool Interrupts::came() {
  char byte;
  while (read(descriptor_, &byte, 1) == 1) came_ = true;
  return came_;
}

WorkerProcess::WorkerProcess(Interrupts& interrupts) : interrupts_(interrupts) {
  int in[2] = {-1, -1}, out[2] = {-1, -1};
  if (pipe2(in, O_CLOEXEC) != 0 || pipe2(out, O_CLOEXEC) != 0) {
    const int error = errno;
    closeBoth(in);
    fail(fmt::format("sweep: no pipe to a worker: {}", std::strerror(error)));
  }
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, in[0], STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, out[1], STDOUT_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t defaults;
  sigemptyset(&defaults);
  sigaddset(&defaults, SIGPIPE);
  posix_spawnattr_setsigdefault(&attributes, &defaults);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
  char name[] = "tessera", command[] = "sweep-worker", quiet[] = "--quiet";
  char* const arguments[] = {name, command, support::Progress::silenced() ? quiet : nullptr, nullptr};
  // The program that runs, also where a new one has been built in its place.
  const int error = posix_spawn(&child_, "/proc/self/exe", &actions, &attributes, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  close(in[0]);
  close(out[1]);
  in_ = in[1];
  out_ = out[0];
  if (error != 0) {
    close(in_);
    close(out_);
    fail(fmt::format("sweep: a worker cannot be started: {}", std::strerror(error)));
  }
}

WorkerProcess::~WorkerProcess() {
  close(in_);
  close(out_);
  wait(true);
}

void WorkerProcess::wait(bool killIt) {
  if (status_) return;
  if (killIt) ::kill(child_, SIGKILL);
  int status = 0;
  while (waitpid(child_, &status, 0) < 0 && errno == EINTR) {
  }
  status_ = status;
}

void WorkerProcess::send(const Json& message) {
  const std::string line = lineOf(message);
  std::string_view rest = line;
  while (!rest.empty()) {
    const ssize_t put = write(in_, rest.data(), rest.size());
    if (put < 0 && errno == EINTR) continue;
    if (put <= 0) return;  // it has ended, which receive() tells
    rest.remove_prefix(static_cast<std::size_t>(put));
  }
}

std::optional<Json> WorkerProcess::receive() {
  for (;;) {
    if (interrupts_.came()) throw Interrupted{};
    if (const std::size_t end = pending_.find('\n'); end != std::string::npos) {
      try {
        Json message = parsedLine(std::string_view(pending_).substr(0, end));
        textAt(message, "event");
        pending_.erase(0, end + 1);
        return message;
      } catch (const WrongField& wrong) {
        fail(fmt::format("sweep: a worker's message cannot be read: {}", wrong.what()));
      }
    }
    pollfd wanted[] = {{out_, POLLIN, 0}, {interrupts_.descriptor(), POLLIN, 0}};
    if (poll(wanted, 2, -1) < 0 && errno != EINTR) fail(fmt::format("sweep: poll: {}", std::strerror(errno)));
    if (wanted[0].revents == 0) continue;
    char chunk[65536];
    const ssize_t got = read(out_, chunk, sizeof chunk);
    if (got > 0) pending_.append(chunk, static_cast<std::size_t>(got));
    if (got == 0) {
      if (interrupts_.came()) throw Interrupted{};  // what ended it came to both
      return {};
    }
  }
}

std::string WorkerProcess::ending() {
  wait(false);
  if (WIFSIGNALED(*status_)) {
    const char* const name = sigabbrev_np(WTERMSIG(*status_));
    return fmt::format("its process was ended by SIG{}{}", name != nullptr ? name : std::to_string(WTERMSIG(*status_)),
                       WTERMSIG(*status_) == SIGKILL ? " (from outside, or for lack of memory)" : "");
  }
  return fmt::format("its process ended with exit code {}", WEXITSTATUS(*status_));
}

}  // namespace tessera::harness
