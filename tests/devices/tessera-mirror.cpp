// The command `tessera` of somebody who has added a kind of devices: nothing but the kind is new.
#include "host/cli/command-line.h"
#include "mirror-kind.h"

int main(int argc, char** argv) {
  tessera::registerDevice(tessera::test::mirrorKind(std::make_shared<tessera::test::MirrorLog>()));
  return tessera::cli::runCommandLine(argc, argv);
}
