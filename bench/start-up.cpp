// How long a command takes before and beside its work: whole processes, in turns, each as its caller waits for it.
#include <fmt/format.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "host/support/table.h"

extern char** environ;

namespace {

struct Job {
  std::string name, command, bar;
  std::vector<double> wall = {}, processor = {};  // ms, one a round
};

double milliseconds(const timeval& time) {
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-3 * static_cast<double>(time.tv_usec);
}

// Without a shell: its start would be measured, too.
void run(Job& job) {
  std::vector<std::string> words{TESSERA_PROGRAM};
  for (std::size_t at = 0, end = 0; at < job.command.size(); at = end + 1) {
    end = std::min(job.command.find(' ', at), job.command.size());
    words.push_back(job.command.substr(at, end - at));
  }
  std::vector<char*> arguments;
  for (auto& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t silent;
  posix_spawn_file_actions_init(&silent);
  for (const int stream : {1, 2}) posix_spawn_file_actions_addopen(&silent, stream, "/dev/null", 1 /* write */, 0);
  const auto start = std::chrono::steady_clock::now();
  pid_t child = 0;
  if (posix_spawn(&child, TESSERA_PROGRAM, &silent, nullptr, arguments.data(), environ) != 0) std::exit(1);
  rusage used{};
  int status = 0;
  wait4(child, &status, 0, &used);
  job.wall.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  job.processor.push_back(milliseconds(used.ru_utime) + milliseconds(used.ru_stime));
  posix_spawn_file_actions_destroy(&silent);
}

std::string quartiles(std::vector<double> times) {
  std::ranges::sort(times);
  return fmt::format("{:.1f} ({:.1f} to {:.1f})", times[times.size() / 2], times[times.size() / 4],
                     times[3 * times.size() / 4]);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"The command's start, in whole processes."};
  int rounds = 21;
  app.add_option("--rounds", rounds, "of all commands in turns")->check(CLI::Range(1, 10000))->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  const std::string picture =
      (std::filesystem::temp_directory_path() / fmt::format("tessera-start-up-{}", getpid())).string();
  const std::string mesh = "render generate:icosphere?level=3";
  std::vector<Job> jobs{{"--version", "--version", "20"},
                        {"an error", "render nosuch.obj", "20"},
                        {"render, no picture", mesh, "150"},
                        {"render -o .png", mesh + " -o " + picture + ".png", "-"},
                        {"render -o .exr", mesh + " -o " + picture + ".exr", "-"}};
  for (int round = -1; round < rounds; ++round) {  // one before the first compiles kernels
    for (auto& job : jobs) run(job);
    if (round < 0)
      for (auto& job : jobs) job.wall.clear(), job.processor.clear();
  }
  std::vector<std::vector<std::string>> rows{{"command", "wall, ms", "processor, ms", "bar, ms"}};
  for (const auto& job : jobs) rows.push_back({job.name, quartiles(job.wall), quartiles(job.processor), job.bar});
  fmt::print("{}{} rounds in turns; median (quartiles)\n", tessera::support::table(rows), rounds);
  for (const char* const extension : {".png", ".exr"}) std::filesystem::remove(picture + extension);
}
