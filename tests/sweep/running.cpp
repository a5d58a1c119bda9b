#include "running.h"

#include <fmt/format.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <sstream>
#include <thread>

namespace tessera::test {
namespace {

namespace fs = std::filesystem;

/// State and parent of a process, from /proc/PID/stat: behind the name, which is in brackets and may hold anything.
std::pair<char, pid_t> statOf(const fs::path& folder) {
  std::ifstream file(folder / "stat");
  std::string text((std::istreambuf_iterator<char>(file)), {});
  const std::size_t end = text.rfind(')');
  if (end == std::string::npos) return {'X', 0};
  char state = 'X';
  pid_t parent = 0;
  std::istringstream(text.substr(end + 1)) >> state >> parent;
  return {state, parent};
}

}  // namespace

std::string tileSweep(unsigned rounds, unsigned repeats, const std::string& more) {
  return fmt::format(
      "title = \"Tile size\"\nquestion = \"Which tile edge is fastest?\"\nsizes = [64]\nthreads = [1]\nrounds = {}\n"
      "repeats = {}\n{}\n[scenes]\nball = \"generate:icosphere?level=2\"\n[set]\ncommit = \"tile-owned\"\n[axes]\n"
      "tile = [8, 16, 32]\n",
      rounds, repeats, more);
}

std::vector<Json> linesOf(const Desk& desk, const std::string& name) {
  std::vector<Json> lines;
  std::istringstream text(desk.read(name));
  for (std::string line; std::getline(text, line);) lines.push_back(Json::parse(line));
  return lines;
}

std::vector<Json> journalLines(const Desk& desk, const std::string& folder, const std::string& kind) {
  std::vector<Json> lines = linesOf(desk, folder + "/journal.jsonl");
  std::erase_if(lines, [&](const Json& line) { return line["kind"] != kind; });
  return lines;
}

std::vector<Json> timelessRows(const Desk& desk, const std::string& folder) {
  std::vector<Json> rows = linesOf(desk, folder + "/rows.jsonl");
  for (Json& row : rows) {
    row.erase("run_id");
    row.erase("time_ns");
    row["provenance"].erase("utc");
  }
  return rows;
}

std::size_t sizeOf(const Desk& desk, const std::string& name) {
  std::error_code absent;
  const auto size = fs::file_size(desk.path() / name, absent);
  return absent ? 0 : size;
}

Running::Running(const Desk& desk, const std::string& arguments) {
  static int number = 0;
  err_ = fmt::format("{}.err{}", desk.path().string(), number++);
  const std::string command = fmt::format("cd '{}' && exec '{}' {} </dev/null >/dev/null 2>'{}'", desk.path().string(),
                                          TESSERA_PROGRAM, arguments, err_);
  child_ = fork();
  if (child_ != 0) {
    setpgid(child_, child_);
    return;
  }
  setpgid(0, 0);
  execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
  _exit(127);
}

Running::~Running() {
  if (!ended()) {
    kill(child_, SIGKILL);
    wait();
  }
  std::error_code ignored;
  fs::remove(err_, ignored);
}

bool Running::ended() {
  if (status_ >= 0) return true;
  int status = 0;
  if (waitpid(child_, &status, WNOHANG) != child_) return false;
  status_ = status;
  return true;
}

bool Running::until(const std::function<bool()>& so) {
  while (!so()) {
    if (ended()) return so();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

void Running::signal(int number) const { kill(child_, number); }
void Running::signalGroup(int number) const { kill(-child_, number); }

pid_t Running::worker() const {
  for (const auto& entry : fs::directory_iterator("/proc")) {
    const std::string name = entry.path().filename().string();
    if (name.find_first_not_of("0123456789") == std::string::npos && statOf(entry.path()).second == child_)
      return std::stoi(name);
  }
  return 0;
}

int Running::wait() {
  until([&] { return ended(); });
  return WIFEXITED(status_) ? WEXITSTATUS(status_) : 128 + WTERMSIG(status_);
}

std::string Running::err() const {
  std::ifstream file(err_);
  return {std::istreambuf_iterator<char>(file), {}};
}

bool isAlive(pid_t process) {
  const char state = statOf(fs::path("/proc") / std::to_string(process)).first;
  return state != 'X' && state != 'Z';
}

}  // namespace tessera::test
