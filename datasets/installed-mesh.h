// `mesh:NAME`: real meshes by name, out of the archive that Debian's libcgal-demo installs.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace tessera::datasets {

inline constexpr std::string_view kInstalledMesh = "mesh:";

/// NAME.off of the archive, unpacked when first asked for into the folder `meshes` beside the compiled kernels. Throws
/// kUsage, saying what to install.
std::filesystem::path installedMesh(std::string_view name);

/// The names that there are, sorted; none where the archive is not installed. Listed once, beside the unpacked meshes.
std::vector<std::string> installedMeshes();

}  // namespace tessera::datasets
