#include <fmt/format.h>
#include <tessera/error.h>
#include <unistd.h>

#include <map>

#include "host/support/files.h"
#include "host/support/output-place.h"

namespace tessera::support {
namespace {

namespace fs = std::filesystem;

/// The same for every name of a file, also of one that is not there yet. Nothing for what may be shared.
std::string identityOf(const OutputPlace& place) {
  if (place.there && S_ISCHR(place.there->st_mode))
    return place.descriptor >= 0 ? fmt::format("descriptor {}", place.descriptor) : "";
  if (place.there) return fmt::format("{} {}", place.there->st_dev, place.there->st_ino);
  struct stat folder {};
  if (stat(folderOf(place.file).c_str(), &folder) != 0) return fs::absolute(place.file).lexically_normal().string();
  return fmt::format("{} {} {}", folder.st_dev, folder.st_ino, place.file.filename().string());
}

}  // namespace

bool isStdout(const fs::path& target) { return outputPlace(target).descriptor == STDOUT_FILENO; }

void checkApart(const std::vector<fs::path>& outputs, const std::vector<fs::path>& inputs) {
  std::map<std::string, fs::path> read, written;
  for (const fs::path& input : inputs) {
    struct stat about {};
    if (stat(input.c_str(), &about) == 0 && S_ISREG(about.st_mode))
      read.emplace(fmt::format("{} {}", about.st_dev, about.st_ino), input);
  }
  for (const fs::path& output : outputs) {
    const OutputPlace place = outputPlace(output);
    const std::string identity = identityOf(place);
    if (identity.empty()) continue;
    if (const auto found = read.find(identity); found != read.end())
      failUsage(found->second == output ? fmt::format("{}: is an input; another name would keep it", output.string())
                                        : fmt::format("{}: is the input {}; another name would keep it",
                                                      output.string(), found->second.string()));
    if (const auto [found, isNew] = written.emplace(identity, output); !isNew)
      failUsage(found->second == output
                    ? fmt::format("{}: is named twice as an output; each needs a name of its own", output.string())
                    : fmt::format("{}: is the same file as {}; each output needs a name of its own", output.string(),
                                  found->second.string()));
  }
}

}  // namespace tessera::support
