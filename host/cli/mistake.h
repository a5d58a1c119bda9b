// What was typed wrong, in one line that says what would be right.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace tessera::cli {

/// What is wrong on a command line that was parsed without an error: CLI11 takes an empty value, and an option's name
/// in the place of one. `words` are those after the program's name. "" where nothing is.
std::string mistakeText(const CLI::App& app, const std::vector<std::string>& words);

/// `error` is what parsing ended with. "" where it is a request for help or the version that can be met.
std::string mistakeText(const CLI::App& app, const std::vector<std::string>& words, const CLI::ParseError& error);

/// The command of this name. Throws kUsage, naming those there are.
const CLI::App& commandNamed(const CLI::App& app, const std::string& name);

}  // namespace tessera::cli
