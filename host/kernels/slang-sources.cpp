#include "host/kernels/slang-sources.h"

#include <fmt/format.h>
#include <tessera/error.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string_view>
#include <vector>

#include "host/support/file-faults.h"

namespace tessera::kernels {
namespace {

namespace fs = std::filesystem;

bool isFile(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  return first == std::string_view::npos ? std::string_view() : text.substr(first);
}

/// Takes `word` and the space after it off the front of `line`.
bool takeWord(std::string_view& line, std::string_view word) {
  if (line.substr(0, word.size()) != word) return false;
  const std::string_view rest = line.substr(word.size());
  if (rest.empty() || (rest[0] != ' ' && rest[0] != '\t' && rest[0] != '"' && rest[0] != '<')) return false;
  line = trimmed(rest);
  return true;
}

/// File names, without a folder to start from, that one line of Slang asks for.
std::vector<fs::path> namedBy(std::string_view line) {
  line = trimmed(line);
  if (!line.empty() && line[0] == '#') {
    line = trimmed(line.substr(1));
    if (!takeWord(line, "include")) return {};
  } else {
    while (takeWord(line, "public") || takeWord(line, "internal") || takeWord(line, "__exported")) {
    }
    if (!takeWord(line, "import") && !takeWord(line, "__include") && !takeWord(line, "implementing")) return {};
  }
  if (line.empty()) return {};
  if (line[0] == '"' || line[0] == '<') {
    const std::string file(line.substr(1, line.find_first_of("\">", 1) - 1));
    return {file, file + ".slang"};
  }
  std::string module(line.substr(0, line.find_first_of("; \t\r/")));
  std::replace(module.begin(), module.end(), '.', '/');
  std::string dashed = module;
  std::replace(dashed.begin(), dashed.end(), '_', '-');
  return {dashed + ".slang", module + ".slang"};
}

}  // namespace

std::vector<fs::path> searchFolders(const fs::path& root) {
  std::vector<fs::path> folders;
  for (const char* const room : {"machine", "math", "records", "geometry", "axes"}) folders.push_back(root / room);
  folders.push_back(root);
  return folders;
}

bool usesLanes(std::string_view text) { return text.find("tessera::") != text.npos; }

std::string machineText(const fs::path& root, bool lanes, unsigned laneWidth) {
  std::string text = lanes && laneWidth ? fmt::format("#define TESSERA_LANES {}\n", laneWidth) : "";
  for (const char* const name : {"machine/atomics-cpp.h", lanes ? "machine/lanes-cpp.h" : ""})
    if (const fs::path header = root / name; *name && fs::exists(header)) text += readText(header);
  return text;
}

std::string readText(const fs::path& path, ExitCode refusal) {
  const auto refuse = [&](const std::string& why, ExitCode code) {
    throw Error(code == ExitCode::kUsage ? refusal : code, fmt::format("{}: {}", path.string(), why));
  };
  if (const std::string why = support::whyNoFile(path); !why.empty()) refuse(why, ExitCode::kUsage);
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file) refuse(fmt::format("cannot be read: {}", std::strerror(errno)), support::codeOf(errno));
  std::string text(static_cast<std::size_t>(std::max<std::streamoff>(file.tellg(), 0)), '\0');
  file.seekg(0);
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (!file) refuse("cannot be read", ExitCode::kFailure);
  return text;
}

std::map<fs::path, std::string> slangSources(const fs::path& root, const fs::path& entry,
                                             const std::string& generated) {
  std::map<fs::path, std::string> sources;
  std::vector<fs::path> pending{entry.lexically_normal()};
  std::vector<fs::path> folders = searchFolders(root);
  folders.emplace_back();  // for the folder of the file in hand
  const auto scan = [&](const std::string& text, const fs::path& beside) {
    folders.back() = beside;
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = std::min(text.find('\n', at), text.size());
      for (const fs::path& name : namedBy(std::string_view(text).substr(at, end - at)))
        for (const fs::path& folder : folders)
          if (const fs::path file = (folder / name).lexically_normal(); !sources.count(file) && isFile(file))
            pending.push_back(file);
      at = end + 1;
    }
  };
  scan(generated, root);
  while (!pending.empty()) {
    const fs::path file = pending.back();
    pending.pop_back();
    const auto [place, isNew] = sources.try_emplace(file);
    if (!isNew) continue;
    place->second = readText(file, ExitCode::kUsage);
    scan(place->second, file.parent_path());
  }
  return sources;
}

}  // namespace tessera::kernels
