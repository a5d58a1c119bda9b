// tessera meshes: what INPUT may name beside files, a line each.
#include <tessera/input.h>

#include "datasets/installed-mesh.h"
#include "host/cli/commands.h"
#include "host/support/terminal.h"

namespace tessera::cli {

Command addMeshes(CLI::App& app) {
  auto* const command =
      app.add_subcommand("meshes", "list the installed meshes and the generators that INPUT may name");
  command->footer("Example:\n  tessera meshes");
  return {command, [] {
            const auto installed = datasets::installedMeshes();
            for (const std::string& name : installed) support::say(stdout, "{}{}\n", datasets::kInstalledMesh, name);
            for (const GeneratorDoc& generator : generatorDocs()) support::say(stdout, "generate:{}\n", generator.name);
            if (installed.empty())
              support::say(stderr, "no mesh is installed: Debian's libcgal-demo, with its doc folder, has some\n");
            return ExitCode::kDone;
          }};
}

}  // namespace tessera::cli
