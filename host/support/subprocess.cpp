#include "host/support/subprocess.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <tessera/error.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>

extern char** environ;

namespace tessera::support {
namespace {

/// The environment of this process, with messages in English: their first error line is what we quote.
std::vector<char*> childEnvironment(std::string& temporary) {
  static char locale[] = "LC_ALL=C";
  std::vector<char*> variables;
  const auto stays = [&](const char* variable) {
    return std::strncmp(variable, "LC_ALL=", 7) != 0 &&
           (temporary.empty() || std::strncmp(variable, "TMPDIR=", 7) != 0);
  };
  for (char** variable = environ; *variable != nullptr; ++variable)
    if (stays(*variable)) variables.push_back(*variable);
  variables.push_back(locale);
  if (!temporary.empty()) variables.push_back(temporary.data());
  variables.push_back(nullptr);
  return variables;
}

[[noreturn]] void failToRun(const std::string& program, int error) {
  const std::string line = fmt::format("{}: cannot be run: {}", program, std::strerror(error));
  if (error == EAGAIN || error == ENOMEM || error == EMFILE || error == ENFILE)
    throw ShortageError(ExitCode::kFailure, line);
  fail(line);
}

}  // namespace

ProcessResult runProcess(const std::vector<std::string>& arguments, const std::filesystem::path& temporary) {
  // Close-on-exec, or a child started by another thread would hold our pipe open.
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) failToRun(arguments[0], errno);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);

  std::vector<char*> argv;
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  pid_t child = 0;
  std::string variable = temporary.empty() ? "" : "TMPDIR=" + temporary.string();
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t defaults;  // SIGPIPE is ignored here: see host/cli/main.cpp
  sigemptyset(&defaults);
  sigaddset(&defaults, SIGPIPE);
  posix_spawnattr_setsigdefault(&attributes, &defaults);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
  const int error = posix_spawn(&child, argv[0], &actions, &attributes, argv.data(), childEnvironment(variable).data());
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  close(ends[1]);
  if (error != 0) {
    close(ends[0]);
    failToRun(arguments[0], error);
  }

  ProcessResult result;
  char chunk[4096];
  for (ssize_t got; (got = read(ends[0], chunk, sizeof chunk)) != 0;) {
    if (got > 0)
      result.output.append(chunk, static_cast<std::size_t>(got));
    else if (errno != EINTR)
      break;
  }
  close(ends[0]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  result.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return result;
}

std::filesystem::path findProgram(std::string_view name) {
  if (name.empty()) return {};
  if (name.find('/') != std::string_view::npos) return name;
  const char* path = std::getenv("PATH");
  std::string_view rest = path != nullptr ? path : "/usr/local/bin:/usr/bin:/bin";
  while (!rest.empty()) {
    const std::size_t colon = rest.find(':');
    const std::filesystem::path candidate = std::filesystem::path(rest.substr(0, colon)) / name;
    if (access(candidate.c_str(), X_OK) == 0 && !std::filesystem::is_directory(candidate)) return candidate;
    rest = colon == std::string_view::npos ? std::string_view() : rest.substr(colon + 1);
  }
  return {};
}

}  // namespace tessera::support
