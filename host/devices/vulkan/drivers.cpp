#include "host/devices/vulkan/drivers.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <set>

namespace tessera::devices::vulkan {
namespace {

namespace fs = std::filesystem;

struct Variable {
  const char* name;
  About about;
  bool files;  ///< its value is a list of files or folders, separated by colons
};
/// The loader's own documentation (LoaderInterfaceArchitecture.md) lists them; XDG_* move the folders that it searches.
constexpr Variable kVariables[] = {{"VK_ICD_FILENAMES", About::kDrivers, true},
                                   {"VK_DRIVER_FILES", About::kDrivers, true},
                                   {"VK_ADD_DRIVER_FILES", About::kDrivers, true},
                                   {"VK_LOADER_DRIVERS_SELECT", About::kDrivers, false},
                                   {"VK_LOADER_DRIVERS_DISABLE", About::kDrivers, false},
                                   {"VK_LAYER_PATH", About::kLayers, true},
                                   {"VK_ADD_LAYER_PATH", About::kLayers, true},
                                   {"VK_INSTANCE_LAYERS", About::kLayers, false},
                                   {"VK_LOADER_LAYERS_ENABLE", About::kLayers, false},
                                   {"VK_LOADER_LAYERS_DISABLE", About::kLayers, false},
                                   {"XDG_DATA_DIRS", About::kDrivers, true},
                                   {"XDG_CONFIG_DIRS", About::kDrivers, true}};

std::set<std::string, std::less<>>& ours() {
  static std::set<std::string, std::less<>> names;
  return names;
}

/// Nothing where it is not set.
const char* valueOf(const Variable& variable) {
  return ours().contains(variable.name) ? nullptr : std::getenv(variable.name);
}

/// Its files that are not there, or are not what a list may hold.
std::vector<std::string> faults(const Variable& variable, std::string_view value) {
  std::vector<std::string> list;
  if (!variable.files) return list;
  while (!value.empty()) {
    const std::size_t colon = value.find(':');
    const fs::path file = value.substr(0, colon);
    std::error_code error;
    if (!file.empty() && !fs::exists(file, error)) list.push_back(file.string());
    value = colon == std::string_view::npos ? std::string_view() : value.substr(colon + 1);
  }
  return list;
}

std::string describe(const Variable& variable, std::string_view value) {
  const std::vector<std::string> missing = faults(variable, value);
  std::string text = fmt::format("{}={}", variable.name, value);
  if (value.empty()) text += " (empty)";
  if (missing.size() == 1 && missing[0] == value) return text + " (no such file)";
  return missing.empty() ? text : fmt::format("{} (no such file: {})", text, fmt::join(missing, ", "));
}

bool takePrefix(std::string_view& text, std::string_view prefix) {
  if (!text.starts_with(prefix)) return false;
  text.remove_prefix(prefix.size());
  return true;
}

}  // namespace

void ownVariable(std::string_view name) { ours().emplace(name); }

std::vector<std::string> variablesSet(About about) {
  std::vector<std::string> list;
  for (const Variable& variable : kVariables)
    if (const char* value = valueOf(variable); value != nullptr && variable.about == about)
      // A desktop sets these two to folders that need not be there.
      if (!std::string_view(variable.name).starts_with("XDG_") || !faults(variable, value).empty())
        list.push_back(describe(variable, value));
  return list;
}

std::vector<std::string> missingFiles() {
  std::vector<std::string> list;
  for (const Variable& variable : kVariables)
    if (const char* value = valueOf(variable); value != nullptr && !faults(variable, value).empty())
      if (!std::string_view(variable.name).starts_with("XDG_")) list.push_back(describe(variable, value));
  return list;
}

std::string plainWords(std::string_view text) {
  while (text.ends_with('\n') || text.ends_with('.')) text.remove_suffix(1);
  // "Found no drivers" is what we say ourselves; that a library failed is in the line before, with the reason.
  if (text.ends_with("Found no drivers!") || text.find("Failed loading library associated with ICD JSON") != text.npos)
    return "";
  for (const std::string_view function : {"loader_get_json: ", "loader_icd_scan: ", "loader_parse_icd_manifest: ",
                                          "loader_scanned_icd_add: ", "vkCreateInstance: "})
    takePrefix(text, function);
  if (takePrefix(text, "Failed to parse JSON file "))  // "..., this is usually because something ran out of memory"
    return fmt::format("{}: not a valid JSON file", text.substr(0, text.find(',')));
  if (takePrefix(text, "Failed to open JSON file ")) return fmt::format("{}: cannot be read", text);
  return std::string(text);
}

std::string driverFailure(std::string_view what, const std::vector<std::string>& causes, About about) {
  const std::vector<std::string> variables = variablesSet(about);
  std::string line(what);
  if (!variables.empty()) line += fmt::format(" with {}", fmt::join(variables, ", "));
  if (!causes.empty()) line += fmt::format(": {}", fmt::join(causes, "; "));
  const char* const package = about == About::kDrivers ? "mesa-vulkan-drivers" : "vulkan-validationlayers";
  if (variables.empty()) return fmt::format("{}; Debian's {} would do", line, package);
  const char* const names =
      about == About::kDrivers ? "the .json file of a driver that is there" : "the folder of a layer that is there";
  return fmt::format("{}; unset {}, or name {} (Debian: {})", line, variables.size() == 1 ? "it" : "them", names,
                     package);
}

}  // namespace tessera::devices::vulkan
