#include "experiments/harness/folder.h"

#include <fmt/format.h>
#include <tessera/error.h>

#include "experiments/harness/rows.h"
#include "host/measure/row.h"
#include "host/support/files.h"

namespace tessera::harness {
namespace {

namespace fs = std::filesystem;

/// As files that are not finished are named.
bool isHalfFile(const fs::path& path) {
  const std::string name = path.filename().string();
  return name.ends_with(".tmp") &&
         (name.starts_with("journal.jsonl.") || name.starts_with("rows.jsonl.") || name.starts_with("sweep.toml."));
}

}  // namespace

std::optional<Record> recordOf(const fs::path& folder, bool resume) {
  std::error_code ignored;
  if (fs::exists(folder, ignored) && !fs::is_directory(folder, ignored))
    failUsage(fmt::format("--out {}: is a file; the name of a folder would do", folder.string()));
  support::checkOutputFolder(folder);
  if (!fs::exists(journalOf(folder), ignored)) {
    for (const auto& entry : fs::directory_iterator(folder, ignored))
      if (!isHalfFile(entry.path()))
        failUsage(fmt::format("--out {}: holds {} and no sweep; a new or an empty folder would do", folder.string(),
                              entry.path().filename().string()));
    return {};
  }
  if (!resume)
    failUsage(fmt::format("--out {}: holds a sweep already; --resume goes on with it, another folder begins anew",
                          folder.string()));
  Record record = readJournal(folder);
  if (const int version = record.head.at("schema_version"); version != measure::kRowSchemaVersion)
    failUsage(
        fmt::format("{}:1: rows of version {}, this program's have {}; the program that began it goes on with it, or a "
                    "new folder begins anew",
                    journalOf(folder).string(), version, measure::kRowSchemaVersion));
  checkRowsKept(folder, record);
  return record;
}

void removeHalfFiles(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (isHalfFile(entry.path())) found.push_back(entry.path());
  for (const auto& path : found) fs::remove(path, ignored);
}

}  // namespace tessera::harness
