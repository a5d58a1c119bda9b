#include "datasets/installed-mesh.h"

#include <fmt/format.h>

#include <algorithm>

#include "host/compiler-tools.h"
#include "host/error.h"
#include "host/files.h"
#include "host/subprocess.h"

namespace tessera {

namespace fs = std::filesystem;

fs::path installedMesh(std::string_view name) {
  const fs::path archive = "/usr/share/doc/libcgal-demo/data.tar.gz";
  const bool plain = !name.empty() && std::ranges::all_of(name, [](unsigned char c) {
    return std::isalnum(c) || c == '-' || c == '_' || c == '.';
  });
  if (!plain) failUsage(fmt::format("mesh:{}: not a name; one such as mesh:refined_elephant would be right", name));
  std::error_code error;
  if (!fs::is_regular_file(archive, error))
    failUsage(fmt::format("mesh:{}: {} is not there; Debian's libcgal-demo, with its doc folder, has it", name,
                          archive.string()));
  const fs::path folder = defaultCacheFolder() / "meshes", mesh = folder / fmt::format("{}.off", name);
  // Unpacked anew where the package is newer.
  const auto unpacked = fs::last_write_time(mesh, error);
  if (!error && unpacked > fs::last_write_time(archive, error)) return mesh;

  const fs::path tar = findProgram("tar");
  if (tar.empty()) failUsage(fmt::format("mesh:{}: tar, which unpacks it, is not in PATH", name));
  // Beside its name and renamed: others may unpack it at the same time.
  const TemporaryFolder work(folder, "unpacked");
  const std::string member = fmt::format("data/meshes/{}.off", name);
  const ProcessResult result =
      runProcess({tar.string(), "-xzf", archive.string(), "-C", work.path().string(), "--touch", "--", member});
  if (!result.ok())
    failUsage(fmt::format("mesh:{}: {} could not be taken out of {} (tar -tzf lists what is in it)", name, member,
                          archive.string()));
  fs::rename(work.path() / member, mesh, error);
  if (error) fail(fmt::format("{}: cannot be written: {}", mesh.string(), error.message()));
  return mesh;
}

}  // namespace tessera
