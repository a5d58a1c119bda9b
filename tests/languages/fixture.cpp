#include "fixture.h"

#include <tessera/cpu-device.h>
#include <tessera/vulkan-device.h>

#include <fstream>

#include "host/kernels/slang-sources.h"

namespace tessera::test {

namespace fs = std::filesystem;

fs::path example(const std::string& name) {
  const fs::path root = TESSERA_SOURCE_DIR, here = root / "tests/languages" / name;
  return fs::exists(here) ? here : root / "slang/by-hand" / name;
}

Bench::Bench() : folder(fs::temp_directory_path(), "tessera-languages") {}

fs::path Bench::write(const std::string& name, const std::string& text) const {
  std::ofstream(folder.path() / name) << text;
  return folder.path() / name;
}

fs::path Bench::edited(const std::string& name, const Edits& edits) const {
  std::string text = kernels::readText(example(name));
  for (const auto& [from, to] : edits) {
    const std::size_t at = text.find(from);
    INFO(name << ": " << from);
    REQUIRE(at != std::string::npos);
    text.replace(at, from.size(), to);
  }
  return write(name, text);
}

Machine machineWith(const std::string& route, const KernelFiles& files) {
  KernelCache::Options options;
  options.files = files;
  return Machine("with files", route, route == "cpp" ? makeCpuDevice() : makeVulkanDevice(), options);
}

Scene smallScene() {
  Scene scene;
  scene.width = 40;
  scene.height = 24;
  scene.positions = {{-0.8f, -0.7f, 0.5f}, {0.7f, -0.6f, 0.25f}, {-0.1f, 0.8f, 0.75f}, {0.9f, 0.9f, 0.125f}};
  scene.triangles = {{0, 1, 2}, {1, 2, 3}};
  return scene;
}

}  // namespace tessera::test
