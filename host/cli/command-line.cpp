#include "host/cli/command-line.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <new>
#include <system_error>
#include <vector>

#include "host/build-info.h"
#include "host/cli/commands.h"
#include "host/cli/help.h"
#include "host/cli/mistake.h"
#include "host/support/terminal.h"

namespace {

using namespace tessera;

ExitCode complain(ExitCode code, std::string line) {
  std::replace(line.begin(), line.end(), '\n', ' ');
  support::say(stderr, "tessera: {}\n", line);
  return code;
}

/// The help or the version that the command line asks for.
void printRequested(const CLI::App& app, const CLI::ParseError& request) {
  const bool version = dynamic_cast<const CLI::CallForVersion*>(&request) != nullptr;
  support::say(stdout, "{}", version ? std::string(request.what()) + '\n' : app.help());
}

ExitCode runCommand(int argc, char** argv) {
  CLI::App app{"Tessera rasterises triangles in compute shaders, with the same bits on every device."};
  app.name("tessera");
  app.formatter(std::make_shared<cli::HelpFormatter>());
  app.require_subcommand(0, 1);  // a second command's name is an argument, such as that of help
  app.set_help_flag("-h,--help", "print this help");
  const std::string version = fmt::format("tessera {} ({}, {})", TESSERA_VERSION, TESSERA_GIT, TESSERA_BUILD_TYPE);
  app.set_version_flag("-V,--version", version, "print the version");
  app.footer(
      "Examples:\n"
      "  tessera render mesh:refined_elephant -o elephant.png --set shade=smooth\n"
      "  tessera render 'generate:icosphere?level=7' --device vulkan --repeat 20 --json -\n"
      "  tessera parity mesh:refined_elephant\n"
      "'tessera help COMMAND' says more. Results go to stdout, messages to stderr.\n"
      "Exit codes: 0 done; 2 bad usage or input; 3 overflow under overflow=error; 4 the device cannot run "
      "this variant; 5 compare or parity found a difference; 130 a signal stopped sweep; 1 anything else.");
  const std::array commands{cli::addRender(app),     cli::addParity(app),          cli::addCompare(app),
                            cli::addPlan(app),       cli::addDevices(app),         cli::addVariants(app),
                            cli::addMeshes(app),     cli::addKernels(app),         cli::addExpand(app),
                            cli::addSweep(app),      cli::addSweepWorker(app),     cli::addReport(app),
                            cli::addCompletion(app), cli::addComplete(app),        cli::addMan(app),
                            cli::addHelp(app),       cli::addVersion(app, version)};
  if (argc < 2) {
    support::say(stderr, "{}\n", cli::shortHelp(app));
    return ExitCode::kUsage;
  }
  const std::vector<std::string> words(argv + 1, argv + argc);
  try {
    app.parse(argc, argv);
    if (const std::string mistake = cli::mistakeText(app, words); !mistake.empty())
      return complain(ExitCode::kUsage, mistake);
  } catch (const CLI::ParseError& error) {
    if (const std::string mistake = cli::mistakeText(app, words, error); !mistake.empty())
      return complain(ExitCode::kUsage, mistake);
    return printRequested(app, error), ExitCode::kDone;
  }
  for (const auto& command : commands)
    if (command.app->parsed()) return command.run();
  return complain(ExitCode::kUsage, "a command is missing; 'tessera help' lists them");
}

}  // namespace

int tessera::cli::runCommandLine(int argc, char** argv) {
  // A reader that has gone, or a file at its limit, is an error of the write, which says the name.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  ExitCode code = ExitCode::kDone;
  try {
    code = runCommand(argc, argv);
    support::flushStdout();
  } catch (const Error& error) {
    code = complain(error.code(), error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    code = complain(ExitCode::kFailure, fmt::format("{}: {}", error.path1().string(), error.code().message()));
  } catch (const std::system_error& error) {  // fmt's, of a stream, say no name
    code = complain(ExitCode::kFailure, std::ferror(stdout) == 0
                                            ? error.what()
                                            : fmt::format("stdout: could not be written: {}", error.code().message()));
  } catch (const std::bad_alloc&) {
    code = complain(ExitCode::kFailure, "out of memory: a smaller --size or scene would fit");
  } catch (const std::exception& error) {
    code = complain(ExitCode::kFailure, error.what());
  }
  return static_cast<int>(code);
}
