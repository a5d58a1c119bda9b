#include "fixture.h"

#include <fstream>

namespace tessera::test {

std::string Files::write(const std::string& name, std::string_view text) const {
  std::ofstream file(folder_.path() / name, std::ios::binary);
  file << text;
  file.close();
  REQUIRE(file);
  return path(name);
}

std::string readError(const Files& files, const std::string& name, std::string_view text) {
  const std::string path = files.write(name, text);
  const std::string line = usageError([&] { readMesh(path); });
  REQUIRE(line.starts_with(path));
  return name + line.substr(path.size());
}

}  // namespace tessera::test
