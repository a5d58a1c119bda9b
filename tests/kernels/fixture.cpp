#include "fixture.h"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>

namespace tessera::test {

namespace fs = std::filesystem;

void writeText(const fs::path& path, const std::string& text) {
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << text;
}

Environment::Environment(const char* name, const std::string& value) : name_(name) {
  if (const char* before = std::getenv(name)) before_ = before;
  value.empty() ? unsetenv(name) : setenv(name, value.c_str(), 1);
}
Environment::~Environment() { before_.empty() ? unsetenv(name_.c_str()) : setenv(name_.c_str(), before_.c_str(), 1); }

Workshop::Workshop()
    : folder(fs::temp_directory_path(), "tessera-test"),
      slang(folder.path() / "slang"),
      cache(folder.path() / "cache") {
  // What the tools answered about themselves is the same for every test: asked once, in the cache that all tests share.
  KernelCache shared;
  shared.slangc();
  shared.cxx();
  fs::create_directories(cache);
  fs::copy_file(shared.folder() / "tools.json", cache / "tools.json");
  writeText(slang / "stages/scale.slang", R"(import step_size;
struct Frame { uint count; float factor; };
ConstantBuffer<Frame> frame;
StructuredBuffer<float> values;
RWStructuredBuffer<float> results;
RWStructuredBuffer<uint> unused;
[shader("compute")]
[numthreads(1, 1, 1)]
void scaleAll(uint3 group : SV_GroupID)
{
    const uint i = group.x + group.y * 32768;
    if (i >= frame.count) return;
    results[i] = (values[i] * frame.factor + step()) / 3.0;
}
)");
  writeText(slang / "step-size.slang",
            "module step_size;\nimport variant;\npublic float step() { return float(kStep); }\n");
  writeText(slang / "unrelated.slang", "module unrelated;\n");
}

KernelCache Workshop::open(bool boundsChecks, const std::string& flags) const {
  return KernelCache({cache, slang, boundsChecks, flags});
}

KernelRequest scaleRequest(Route route, const std::string& variant) {
  return {"scale", "stages/scale.slang", "scaleAll", route, {"", variant}, "step=1"};
}

std::size_t countFiles(const fs::path& folder, const std::string& ending) {
  std::size_t count = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    count += name.size() >= ending.size() && name.compare(name.size() - ending.size(), ending.size(), ending) == 0;
  }
  return count;
}

}  // namespace tessera::test
