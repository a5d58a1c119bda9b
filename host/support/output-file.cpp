#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <tessera/error.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <system_error>

#include "host/support/file-faults.h"
#include "host/support/files.h"
#include "host/support/output-place.h"
#include "host/support/temporary.h"

namespace tessera::support {
namespace {

namespace fs = std::filesystem;

/// Closed at the end.
struct Descriptor {
  int number = -1;
  ~Descriptor() {
    if (number >= 0) close(number);
  }
};

}  // namespace

struct OutputFile::State {
  OutputPlace place;
  int stream = -1;
  std::unique_ptr<Temporary> temporary;

  explicit State(const fs::path& target) : place(outputPlace(target)) {
    if (place.isFile()) checkBeside(place);
    // Asking for permissions misses read-only and special file systems; making a file does not.
    clearTemporaries(folder(), stem());
    makeTemporary(place.isFile() ? ExitCode::kUsage : ExitCode::kFailure);
    temporary.reset();  // a run that is stopped in the meantime leaves nothing
    if (!place.isFile()) stream = openStream(place);
  }
  ~State() {
    if (stream >= 0) close(stream);
  }
  State(const State&) = delete;

  fs::path folder() const { return place.isFile() ? folderOf(place.file) : temporaryRoot(); }
  std::string stem() const { return place.isFile() ? place.file.filename().string() : "tessera-output"; }

  void makeTemporary(ExitCode refusal) try {
    const bool secret = place.there && (place.there->st_mode & 0077) == 0;
    temporary = std::make_unique<Temporary>(folder(), stem(), Temporary::kFile,
                                            place.isFile() && !secret ? mode_t{0666} : mode_t{0600});
  } catch (const std::system_error& error) {
    const std::string line = fmt::format("{}: no file can be made in {}: {}", place.name.string(), folder().string(),
                                         error.code().message());
    throw Error(codeOf(error.code().value()) == ExitCode::kFailure ? ExitCode::kFailure : refusal, line);
  }

  void copyToStream(int from) {
    std::array<char, 1 << 16> chunk;
    for (ssize_t got; (got = read(from, chunk.data(), chunk.size())) != 0;) {
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) failWriting(place.name, causeOf(errno));
      writeAll(stream, {chunk.data(), static_cast<std::size_t>(got)}, place.name);
    }
    if (!synced(stream)) failWriting(place.name, causeOf(errno));
  }

  void rename(int made) {
    struct stat old {};
    if (stat(place.file.c_str(), &old) == 0 && S_ISREG(old.st_mode)) {
      [[maybe_unused]] const int notOurs = fchown(made, old.st_uid, old.st_gid);  // where we may
      if (fchmod(made, old.st_mode & 0777) != 0) failWriting(place.name, causeOf(errno));
    }
    if (!synced(made)) failWriting(place.name, causeOf(errno));
    std::error_code error;
    fs::rename(temporary->path(), place.file, error);
    if (error) failWriting(place.name, error.message());
    temporary->renamed();
    const Descriptor names{open(folder().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)};
    if (names.number >= 0 && !synced(names.number)) failWriting(place.name, causeOf(errno));
  }
};

OutputFile::OutputFile(const fs::path& target) : state_(std::make_unique<State>(target)) {}
OutputFile::~OutputFile() = default;
OutputFile::OutputFile(OutputFile&&) noexcept = default;

const fs::path& OutputFile::target() const { return state_->place.name; }

const fs::path& OutputFile::path() {
  if (!state_->temporary) state_->makeTemporary(ExitCode::kFailure);
  return state_->temporary->path();
}

std::string OutputFile::whyNotWhole(const std::string& said) try {
  const fs::path folder = path().parent_path();
  if (!state_->place.isFile()) checkWritten(folder, said);  // another TMPDIR helps
  const int error = faultOf(folder, said);
  return error == 0 ? said : causeOf(error);
} catch (const WriteError& error) {
  return error.what();
}

void OutputFile::commit(std::optional<std::uintmax_t> bytes) {
  const fs::path& name = state_->place.name;
  const Descriptor made{open(path().c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC)};
  struct stat about {};
  if (made.number < 0 || fstat(made.number, &about) != 0) failWriting(name, causeOf(errno));
  const auto size = static_cast<std::uintmax_t>(about.st_size);
  if (bytes && size != *bytes) failWriting(name, fmt::format("{} of {} bytes arrived", size, *bytes));
  if (!bytes && size == 0) failWriting(name, "no byte arrived");
  if (state_->place.isFile())
    state_->rename(made.number);
  else
    state_->copyToStream(made.number);
  state_->temporary.reset();
}

void checkWhole(const fs::path& target) {
  if (outputPlace(target).isFile()) OutputFile{target};
}

bool writeNew(const fs::path& target, std::string_view text) try {
  Temporary made(folderOf(target), target.filename().native(), Temporary::kFile);
  writeAll(made.descriptor(), text, target);
  if (!synced(made.descriptor())) failWriting(target, causeOf(errno));
  if (renameat2(AT_FDCWD, made.path().c_str(), AT_FDCWD, target.c_str(), RENAME_NOREPLACE) != 0) {
    if (errno == EEXIST) return false;
    failWriting(target, causeOf(errno));
  }
  made.renamed();
  return true;
} catch (const std::system_error& error) {
  failWriting(target, error.code().message());
}

void checkOutputFolder(const fs::path& folder) {
  fs::path there = folder.empty() ? fs::path(".") : folder;
  struct stat about {};
  while (stat(there.c_str(), &about) != 0) {
    if (errno != ENOENT) failUsage(fmt::format("{}: {}", folder.string(), causeOf(errno)));
    there = there.has_parent_path() && there.parent_path() != there ? there.parent_path() : fs::path(".");
  }
  if (!S_ISDIR(about.st_mode)) failUsage(fmt::format("{}: {} is no folder", folder.string(), there.string()));
  try {
    Temporary(there, "try", Temporary::kFile);
  } catch (const std::system_error& error) {
    failUsage(fmt::format("{}: {} cannot be written: {}", folder.string(), there.string(), error.code().message()));
  }
}

void writeWhole(const fs::path& target, std::string_view text) {
  if (const OutputPlace place = outputPlace(target); !place.isFile()) {
    const Descriptor stream{openStream(place)};
    return writeAll(stream.number, text, target);
  }
  OutputFile file(target);
  {
    const Descriptor beside{open(file.path().c_str(), O_WRONLY | O_NOFOLLOW | O_CLOEXEC)};
    if (beside.number < 0) failWriting(target, causeOf(errno));
    writeAll(beside.number, text, target);
  }
  file.commit(text.size());
}

}  // namespace tessera::support
