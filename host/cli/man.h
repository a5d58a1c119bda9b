// The manual page.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace tessera::cli {

/// tessera(1), for man.
std::string manualPage(const CLI::App& app);

}  // namespace tessera::cli
