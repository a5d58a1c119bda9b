// A user's kernel is content-addressed: an edit of it, or of what it includes, is another kernel.
#include <catch2/catch.hpp>
#include <tuple>
#include <utility>

#include "fixture.h"
#include "host/kernels/slang-sources.h"
#include "host/kernels/user-kernel.h"
#include "host/plan/stages.h"

using namespace tessera;
using namespace tessera::test;

TEST_CASE("An edit of a user's kernel or of what it includes compiles it again") {
  const Bench bench;
  KernelCache shared;  // knows its tools already
  KernelCache::Options options;
  options.folder = bench.folder.path() / "cache";
  std::filesystem::create_directories(options.folder);
  shared.slangc();
  std::filesystem::copy_file(shared.folder() / "tools.json", options.folder / "tools.json");
  KernelCache cache(options);
  DeviceInfo device;
  device.routes = {"spirv", "glsl"};
  const Plan plan = makePlan(smallScene(), {{"shade", "id"}}, device);

  std::size_t compiled = 0;
  const auto compilesAgain = [&](const std::string& stage, const std::filesystem::path& file) {
    cache.get(kernels::requestOf(plan::kernelRequest(stage, plan), file));
    return cache.statistics().compiled != std::exchange(compiled, cache.statistics().compiled);
  };
  for (const auto& [stage, name, include] : {std::tuple{"transform", "transform.comp", "#include \"part.h\"\n"},
                                             {"shade", "by-row.hlsl", "#include \"part.h\"\n"},
                                             {"shade", "by-depth.slang", "import part;\n"}}) {
    INFO(name);
    bench.write("part.h", "#define kPart 1\n");
    bench.write("part.slang", "module part;\n");
    const std::string text = kernels::readText(example(name)),
                      from = std::string(name) == "transform.comp" ? "#include \"settings.glsl\"" : "\n";
    std::string including = text;
    including.insert(including.find(from), "\n" + std::string(include));
    const auto file = bench.write(name, including);
    CHECK(compilesAgain(stage, file));
    CHECK_FALSE(compilesAgain(stage, file));
    bench.write(name, including + "// edited\n");
    CHECK(compilesAgain(stage, file));
    bench.write("part.h", "#define kPart 2\n");
    bench.write("part.slang", "module part; // edited\n");
    CHECK(compilesAgain(stage, file));
    CHECK_FALSE(compilesAgain(stage, file));
    bench.write(name, including);
    CHECK(compilesAgain(stage, file));  // with the edited part it is new
  }
}
