// tessera: the command line.
#pragma once

namespace tessera::cli {

/// main() of the command. Every failure is one line on stderr; returns the exit status, a code of error.h. A program
/// that has registered a kind of devices (registerDevice()) has it in all commands.
int runCommandLine(int argc, char** argv);

}  // namespace tessera::cli
