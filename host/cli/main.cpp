#include "host/cli/command-line.h"

int main(int argc, char** argv) { return tessera::cli::runCommandLine(argc, argv); }
