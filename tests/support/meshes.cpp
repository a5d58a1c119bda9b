#include "meshes.h"

#include <fmt/format.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>

namespace tessera::test {

std::string cgalMesh(const std::string& name) {
  namespace fs = std::filesystem;
  const fs::path folder = TESSERA_BINARY_DIR "/data", mesh = folder / name;
  if (fs::exists(mesh)) return mesh.string();
  fs::create_directories(folder);
  // Beside its name and renamed: tests run side by side.
  const std::string part = fmt::format("{}.{}", mesh.string(), getpid());
  const std::string command =
      fmt::format("tar -xzOf /usr/share/doc/libcgal-demo/data.tar.gz data/meshes/{} > '{}'", name, part);
  INFO("libcgal-demo of packages.txt has to be installed, with its doc folder");
  REQUIRE(std::system(command.c_str()) == 0);
  fs::rename(part, mesh);
  return mesh.string();
}

}  // namespace tessera::test
