#include "datasets/input-files.h"

#include <toml++/toml.h>

#include "datasets/installed-mesh.h"
#include "datasets/text.h"
#include "host/support/text.h"

namespace tessera::datasets {
namespace {

namespace fs = std::filesystem;

bool isFile(std::string_view source) { return !source.starts_with("generate:") && !source.starts_with(kInstalledMesh); }

/// Whatever a scene calls a source, wherever it does so.
void addSources(const toml::node& node, const fs::path& folder, std::vector<fs::path>& files) {
  if (const toml::array* const array = node.as_array())
    for (const toml::node& item : *array) addSources(item, folder, files);
  const toml::table* const table = node.as_table();
  if (table == nullptr) return;
  for (const auto& [key, value] : *table) {
    const auto text = value.value<std::string>();
    if (text && key == "source" && isFile(*text)) files.push_back(folder / *text);
    addSources(value, folder, files);
  }
}

}  // namespace

std::vector<fs::path> inputFiles(const std::string& input) {
  if (!isFile(input)) return {};
  const fs::path path = input;
  std::vector<fs::path> files{path};
  std::error_code error;
  if (support::lowerCase(path.extension().string()) != ".toml" || !fs::is_regular_file(path, error)) return files;
  try {
    addSources(toml::parse_file(path.string()), path.parent_path(), files);
  } catch (const toml::parse_error&) {
    // loadInput() says what is wrong
  }
  return files;
}

}  // namespace tessera::datasets
