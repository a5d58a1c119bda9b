// Sweeps that are watched, stopped and read back. Scenes are tiny, threads are one and commits are tile-owned, so that
// counters do not depend on scheduling.
#pragma once

#include <sys/types.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "../cli/run-tessera.h"

namespace tessera::test {

using Json = nlohmann::json;

/// A sweep over three tile sizes, so of four cells; `more` holds further top-level keys.
std::string tileSweep(unsigned rounds, unsigned repeats, const std::string& more = "");

std::vector<Json> linesOf(const Desk& desk, const std::string& name);
/// Lines of a journal of one kind.
std::vector<Json> journalLines(const Desk& desk, const std::string& folder, const std::string& kind);
/// Rows without what differs from one run to another: times and when they were taken.
std::vector<Json> timelessRows(const Desk& desk, const std::string& folder);
std::size_t sizeOf(const Desk& desk, const std::string& name);  ///< 0 where there is none

/// The program in a process group of its own, its streams in files beside the desk.
class Running {
 public:
  Running(const Desk& desk, const std::string& arguments);
  ~Running();
  Running(const Running&) = delete;

  /// Looks every millisecond until it is so; false when the program ended before.
  bool until(const std::function<bool()>& so);
  void signal(int number) const;       ///< to the program alone
  void signalGroup(int number) const;  ///< as a terminal does
  pid_t worker() const;                ///< its child; 0 where it has none
  int wait();                          ///< exit code, or 128 + the signal's number
  std::string err() const;

 private:
  bool ended();

  pid_t child_ = 0;
  int status_ = -1;
  std::string err_;
};

bool isAlive(pid_t process);

}  // namespace tessera::test
