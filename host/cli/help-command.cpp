// tessera help, version, man and completion: what says what there is.
#include <cstdio>
#include <memory>
#include <vector>

#include "host/cli/commands.h"
#include "host/cli/completion.h"
#include "host/cli/man.h"
#include "host/cli/mistake.h"
#include "host/support/terminal.h"

namespace tessera::cli {

Command addHelp(CLI::App& app) {
  auto name = std::make_shared<std::string>();
  auto* const command = app.add_subcommand("help", "print help, of a command if one is named");
  command->add_option("COMMAND", *name, "one of those that 'tessera help' lists");
  command->footer("Example:\n  tessera help render");
  return {command, [name, &app] {
            // Not app.help(), which goes to the command that was parsed, that is, to this one.
            const auto formatter = app.get_formatter();
            support::say(stdout, "{}",
                         name->empty() ? formatter->make_help(&app, "tessera", CLI::AppFormatMode::Normal)
                                       : commandNamed(app, *name).help("tessera"));
            return ExitCode::kDone;
          }};
}

Command addCompletion(CLI::App& app) {
  auto shell = std::make_shared<std::string>();
  auto* const command =
      app.add_subcommand("completion", "print what makes a shell complete commands, options and values");
  command->add_option("SHELL", *shell, "bash, zsh or fish")->required();
  command->footer(
      "Examples:\n"
      "  tessera completion bash > ~/.local/share/bash-completion/completions/tessera\n"
      "  tessera completion zsh > ~/.zfunc/_tessera\n"
      "  tessera completion fish > ~/.config/fish/completions/tessera.fish\n"
      "The folder has to be there; zsh has to have its folder in fpath. For this shell alone: source <(tessera "
      "completion "
      "bash).");
  return {command, [shell] {
            support::say(stdout, "{}", completionScript(*shell));
            return ExitCode::kDone;
          }};
}

Command addComplete(CLI::App& app) {
  auto words = std::make_shared<std::vector<std::string>>();
  auto* const command = app.add_subcommand("complete", "")->group("");
  command->add_option("WORDS", *words, "");
  return {command, [words, &app] {
            if (words->empty()) words->emplace_back();
            for (const Candidate& candidate : candidates(app, *words))
              support::say(stdout, "{}\t{}\n", candidate.word, candidate.meaning);
            return ExitCode::kDone;
          }};
}

Command addMan(CLI::App& app) {
  auto* const command = app.add_subcommand("man", "print the manual page, for man to show");
  command->footer("Example:\n  tessera man | man -l -");
  return {command, [&app] {
            support::say(stdout, "{}", manualPage(app));
            return ExitCode::kDone;
          }};
}

Command addVersion(CLI::App& app, const std::string& version) {
  auto* const command = app.add_subcommand("version", "print the version");
  command->footer("Example:\n  tessera version");
  return {command, [version] {
            support::say(stdout, "{}\n", version);
            return ExitCode::kDone;
          }};
}

}  // namespace tessera::cli
