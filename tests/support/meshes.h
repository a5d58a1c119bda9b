// Real meshes, where Debian's packages have installed them.
#pragma once

#include <string>

namespace tessera::test {

/// Path of one of the OFF files of libcgal-demo, unpacked into the build tree once. The test fails where the package is
/// missing.
std::string cgalMesh(const std::string& name);

}  // namespace tessera::test
