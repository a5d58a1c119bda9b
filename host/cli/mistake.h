// What was typed wrong, in one line that says what would be right.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace tessera::cli {

/// `error` is what parsing ended with.
std::string mistakeText(const CLI::App& app, const CLI::ParseError& error);

/// The command of this name. Throws kUsage, naming those there are.
const CLI::App& commandNamed(const CLI::App& app, const std::string& name);

}  // namespace tessera::cli
