#include "datasets/installed-mesh.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tessera/error.h>

#include <algorithm>
#include <system_error>

#include "datasets/text.h"
#include "host/support/file-faults.h"
#include "host/support/files.h"
#include "host/support/own-files.h"
#include "host/support/subprocess.h"
#include "host/support/suggest.h"

namespace tessera::datasets {

namespace fs = std::filesystem;

namespace {

constexpr const char* kArchive = "/usr/share/doc/libcgal-demo/data.tar.gz";

/// Whether the archive has given this file since the package was installed. What is no file is made anew.
bool isFresh(const fs::path& file) {
  support::checkOwn(file);
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return false;
  const auto written = fs::last_write_time(file, error);
  return !error && written > fs::last_write_time(kArchive, error) && !error;
}

}  // namespace

std::vector<std::string> installedMeshes() {
  std::error_code error;
  if (!fs::is_regular_file(kArchive, error)) return {};
  const fs::path folder = support::defaultCacheFolder() / "meshes", list = folder / "names";
  std::string members;
  if (isFresh(list)) {
    members = readFile(list);
  } else {
    const fs::path tar = support::findProgram("tar");
    if (tar.empty()) return {};
    const support::ProcessResult result = support::runProcess({tar.string(), "-tzf", kArchive});
    if (!result.ok()) return {};
    members = result.output;
    try {
      support::makeOwnFolder(folder);
      support::writeOwn(list, members);
    } catch (const std::system_error&) {
      // where it cannot be kept it is listed again
    }
  }
  constexpr std::string_view kBegin = "data/meshes/", kEnd = ".off";
  std::vector<std::string> names;
  for (std::string_view rest = members; !rest.empty();) {
    std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    if (!line.starts_with(kBegin) || !line.ends_with(kEnd)) continue;
    line.remove_prefix(kBegin.size());
    line.remove_suffix(kEnd.size());
    if (line.find('/') == line.npos) names.emplace_back(line);
  }
  std::ranges::sort(names);
  return names;
}

fs::path installedMesh(std::string_view name) {
  const fs::path archive = kArchive;
  const bool plain = !name.empty() && std::ranges::all_of(name, [](unsigned char c) {
    return std::isalnum(c) || c == '-' || c == '_' || c == '.';
  });
  std::error_code error;
  if (!fs::is_regular_file(archive, error))
    failUsage(fmt::format("mesh:{}: {} is not there; Debian's libcgal-demo, with its doc folder, has it", name,
                          archive.string()));
  if (name.empty()) failUsage(fmt::format("mesh: of what name? There are {}", fmt::join(installedMeshes(), ", ")));
  if (!plain) failUsage(fmt::format("mesh:{}: not a name; one such as mesh:refined_elephant would be right", name));
  const fs::path folder = support::defaultCacheFolder() / "meshes", mesh = folder / fmt::format("{}.off", name);
  support::checkOwn(folder);
  if (isFresh(mesh)) return mesh;

  const fs::path tar = support::findProgram("tar");
  if (tar.empty()) failUsage(fmt::format("mesh:{}: tar, which unpacks it, is not in PATH", name));
  // Beside its name and renamed: others may unpack it at the same time.
  const support::TemporaryFolder work = [&] {
    try {
      support::makeOwnFolder(folder);
    } catch (const std::system_error& problem) {
      throw Error(support::codeOf(problem.code().value()),
                  fmt::format("{}: cannot be made: {}; a TESSERA_CACHE that can be written would do", folder.string(),
                              problem.code().message()));
    }
    return support::TemporaryFolder(folder, "unpacked");
  }();
  const std::string member = fmt::format("data/meshes/{}.off", name);
  const support::ProcessResult result = support::runProcess(
      {tar.string(), "-xzf", archive.string(), "-C", work.path().string(), "--touch", "--", member});
  if (!result.ok()) support::checkWritten(work.path(), result.output);
  if (!result.ok()) {
    const auto names = installedMeshes();
    if (std::ranges::find(names, name) == names.end()) {
      const std::string close = support::nearest(name, names);
      failUsage(fmt::format("mesh:{}: no such mesh; {}'tessera meshes' lists the {} there are", name,
                            close.empty() ? "" : fmt::format("did you mean mesh:{}? ", close), names.size()));
    }
    failUsage(
        fmt::format("mesh:{}: {} could not be taken out of {}: {}", name, member, archive.string(), result.output));
  }
  try {
    support::makeOwn(work.path() / member);
    support::replaceOwn(work.path() / member, mesh);
  } catch (const std::system_error& problem) {
    throw Error(support::codeOf(problem.code().value()),
                fmt::format("{}: cannot be written: {}", mesh.string(), problem.code().message()));
  }
  return mesh;
}

}  // namespace tessera::datasets
