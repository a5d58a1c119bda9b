// Why Vulkan drivers do not load: the variables that the loader listens to, and what the loader itself says.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tessera::devices::vulkan {

enum class About { kDrivers, kLayers };

/// Those variables of the environment which choose drivers or layers, as "NAME=value", with the files among them that
/// are not there. What tessera set itself (see instance.cpp) is not among them.
std::vector<std::string> variablesSet(About about);

/// As `variablesSet`, but only the variables that name a file or folder which is not there.
std::vector<std::string> missingFiles();

/// A message of the loader as a person would say it; empty for one that says nothing of its own.
std::string plainWords(std::string_view loaderMessage);

/// One line: `what`, the causes in the loader's words, the variables that are set, and what would help.
std::string driverFailure(std::string_view what, const std::vector<std::string>& causes, About about = About::kDrivers);

/// The variable by which tessera adds a driver of its own is tessera's, not the user's.
void ownVariable(std::string_view name);

}  // namespace tessera::devices::vulkan
