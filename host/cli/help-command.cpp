// tessera help and tessera version: what a hand types for --help and --version.
#include <fmt/format.h>

#include <cstdio>
#include <memory>

#include "host/cli/commands.h"
#include "host/cli/mistake.h"

namespace tessera::cli {

Command addHelp(CLI::App& app) {
  auto name = std::make_shared<std::string>();
  auto* const command = app.add_subcommand("help", "print help, of a command if one is named");
  command->add_option("COMMAND", *name, "one of those that 'tessera help' lists");
  command->footer("Example:\n  tessera help render");
  return {command, [name, &app] {
            // Not app.help(), which goes to the command that was parsed, that is, to this one.
            const auto formatter = app.get_formatter();
            fmt::print("{}", name->empty() ? formatter->make_help(&app, "tessera", CLI::AppFormatMode::Normal)
                                           : commandNamed(app, *name).help("tessera"));
            return ExitCode::kDone;
          }};
}

Command addVersion(CLI::App& app, const std::string& version) {
  return {app.add_subcommand("version", "print the version"), [version] {
            fmt::print("{}\n", version);
            return ExitCode::kDone;
          }};
}

}  // namespace tessera::cli
