// `mesh:NAME`: real meshes by name, out of the archive that Debian's libcgal-demo installs.
#pragma once

#include <filesystem>
#include <string_view>

namespace tessera {

inline constexpr std::string_view kInstalledMesh = "mesh:";

/// NAME.off of the archive, unpacked when first asked for into the folder `meshes` beside the compiled kernels. Throws
/// kUsage, saying what to install.
std::filesystem::path installedMesh(std::string_view name);

}  // namespace tessera
