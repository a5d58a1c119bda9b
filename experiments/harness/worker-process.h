// The parent's side of a worker: it starts it, talks to it, and learns how it ended.
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>

#include "experiments/harness/request.h"

namespace tessera::harness {

/// Ctrl-C and SIGTERM, from now on taken where a worker is waited for. One for the program.
class Interrupts {
 public:
  Interrupts();
  ~Interrupts();
  Interrupts(const Interrupts&) = delete;
  int descriptor() const { return descriptor_; }
  bool came();  ///< since it was made

 private:
  int descriptor_ = -1;
  bool came_ = false;
};

/// Thrown by WorkerProcess::receive().
struct Interrupted {};

class WorkerProcess {
 public:
  /// This program again, as its hidden command `sweep-worker`. Throws kFailure if it cannot be started.
  explicit WorkerProcess(Interrupts& interrupts);
  ~WorkerProcess();  ///< kills it
  WorkerProcess(const WorkerProcess&) = delete;

  void send(const Json& message);
  /// The next message; none once it has ended. Throws Interrupted, and kFailure for what is no message.
  std::optional<Json> receive();
  /// "its process was ended by SIGSEGV": after receive() gave none.
  std::string ending();

 private:
  void wait(bool kill);

  Interrupts& interrupts_;
  pid_t child_ = 0;
  int in_ = -1, out_ = -1;  ///< its stdin, its stdout
  std::string pending_;
  std::optional<int> status_;
};

}  // namespace tessera::harness
