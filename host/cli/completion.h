// What may come next on a command line: made from the same options, axes and inputs as the help.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace tessera::cli {

struct Candidate {
  std::string word;     ///< the whole word as it would stand on the command line
  std::string meaning;  ///< one line, or empty
};

/// What the last of `words` may become; the others are what stands between the program's name and it. A word that
/// begins with ":files" or ":folders" asks the shell for names of files, after the text that follows a blank.
std::vector<Candidate> candidates(const CLI::App& app, const std::vector<std::string>& words);

/// What a shell reads: "bash", "zsh" or "fish". Throws kUsage for another.
std::string completionScript(const std::string& shell);

}  // namespace tessera::cli
