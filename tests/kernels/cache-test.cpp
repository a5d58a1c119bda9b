// The kernel cache: what it finds again, what makes another kernel, and what it does about broken entries and other
// processes.
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <fstream>
#include <set>

#include "fixture.h"
#include "host/kernels/slang-sources.h"
#include "host/kernels/spirv.h"

namespace tessera::test {
namespace fs = std::filesystem;

TEST_CASE("A kernel is compiled once and found again") {
  const Workshop shop;
  for (const Route route : {Route::kCpp, Route::kSpirv, Route::kGlsl}) {
    KernelCache first = shop.open();
    const CompiledKernel made = first.get(scaleRequest(route));
    CHECK(fs::file_size(made.binary) > 0);
    CHECK(first.statistics().compiled == 1);
    const CompiledKernel again = first.get(scaleRequest(route));
    CHECK(first.statistics().compiled == 1);
    CHECK(first.statistics().hits == 1);
    KernelCache second = shop.open();
    const CompiledKernel found = second.get(scaleRequest(route));
    CHECK(second.statistics().hits == 1);
    CHECK(second.statistics().compiled == 0);
    for (const CompiledKernel& kernel : {again, found}) {
      CHECK(kernel.hash == made.hash);
      CHECK(kernel.binary == made.binary);
      CHECK(kernel.entry == (route == Route::kCpp ? "scaleAll" : "main"));
      CHECK(kernel.interface.resources == made.interface.resources);
      CHECK(kernel.interface.elementSizes == made.interface.elementSizes);
      CHECK(kernel.interface.blockSize == made.interface.blockSize);
      CHECK(kernel.interface.globalsSize == made.interface.globalsSize);
      CHECK(kernel.interface.fields.at("factor").offset == 4);
    }
  }
  CHECK(countFiles(shop.cache, ".tmp") == 0);
}

TEST_CASE("The interface is slangc's layout without what the kernel never touches") {
  const Workshop shop;
  KernelCache cache = shop.open();
  for (const Route route : {Route::kCpp, Route::kSpirv, Route::kGlsl}) {
    const KernelInterface interface = cache.get(scaleRequest(route)).interface;
    std::set<std::string> names;
    for (const auto& [name, place] : interface.resources) names.insert(name);
    CHECK(names == std::set<std::string>{"frame", "values", "results"});
    CHECK(interface.elementSizes.at("values") == 4);
    CHECK(interface.fields.at("count").offset == 0);
    CHECK(interface.fields.at("factor").size == 4);
    // C++: a pointer to the block, then pointer and count of three buffers, the unused one among them; else bindings.
    CHECK(interface.globalsSize == (route == Route::kCpp ? 8u + 3 * 16 : 0u));
    CHECK(interface.resources.at("results") == (route == Route::kCpp ? 24u : 2u));
  }
}

TEST_CASE("Whatever a kernel is made of changes its key and nothing else does") {
  const Workshop shop;
  std::set<std::string> hashes;
  const auto isNew = [&](const CompiledKernel& kernel) { return hashes.insert(kernel.hash).second; };
  const auto get = [&](const KernelRequest& request = scaleRequest()) { return shop.open().get(request); };
  const std::string step = kernels::readText(shop.slang / "step-size.slang"),
                    scale = kernels::readText(shop.slang / "stages/scale.slang");

  CHECK(isNew(get()));
  CHECK_FALSE(isNew(get()));
  writeText(shop.slang / "unrelated.slang", "module unrelated; // changed\n");
  CHECK_FALSE(isNew(get()));
  CHECK(isNew(get(scaleRequest(Route::kCpp, "module variant;\npublic static const int kStep = 2;\n"))));
  CHECK(isNew(shop.open(true).get(scaleRequest())));
  CHECK(isNew(shop.open(false, "-DX").get(scaleRequest())));
  CHECK(isNew(get(scaleRequest(Route::kSpirv))));
  CHECK(isNew(get(scaleRequest(Route::kGlsl))));

  writeText(shop.slang / "step-size.slang", step + "// an import changed\n");
  CHECK(isNew(get()));
  writeText(shop.slang / "step-size.slang", step);
  CHECK_FALSE(isNew(get()));
  writeText(shop.slang / "stages/scale.slang", scale + "// the file itself changed\n");
  CHECK(isNew(get()));
  writeText(shop.slang / "stages/scale.slang", scale);
  // A module in a room of the sources, which is found by its name alone.
  writeText(shop.slang / "geometry/in-room.slang", "module in_room;\n");
  writeText(shop.slang / "stages/scale.slang", "import in_room;\n" + scale);
  CHECK(isNew(get()));
  writeText(shop.slang / "geometry/in-room.slang", "module in_room; // changed\n");
  CHECK(isNew(get()));
  CHECK_FALSE(isNew(get()));
  writeText(shop.slang / "stages/scale.slang", scale);
  writeText(shop.slang / "machine/atomics-cpp.h", "// stands ahead of the C++\n");
  CHECK(isNew(get()));
  CHECK_FALSE(isNew(get(scaleRequest(Route::kSpirv))));
}

TEST_CASE("Imports are found as slangc finds them") {
  const Workshop shop;
  writeText(shop.slang / "stages/deep/part-one.slang", "import step_size;\n");
  writeText(shop.slang / "textual.slang", "static const int kText = 1;\n");
  writeText(shop.slang / "stages/beside.slang", "module beside;\n");
  writeText(shop.slang / "math/in-room.slang", "import other_room;\n");
  writeText(shop.slang / "axes/other-room.slang", "__include values.one_value;\n");
  writeText(shop.slang / "axes/values/one-value.slang", "implementing other_room;\n");
  writeText(shop.slang / "stages/many.slang",
            "#include \"textual.slang\"\n  public import stages.deep.part_one;\n__exported import beside;\nimport "
            "in_room;\n// "
            "import unrelated_;\n");
  std::set<std::string> names;
  for (const auto& [path, text] :
       kernels::slangSources(shop.slang, shop.slang / "stages/many.slang", "import unrelated;\n"))
    names.insert(path.lexically_relative(shop.slang).string());
  CHECK(names == std::set<std::string>{"stages/many.slang", "textual.slang", "stages/deep/part-one.slang",
                                       "step-size.slang", "stages/beside.slang", "unrelated.slang",
                                       "math/in-room.slang", "axes/other-room.slang", "axes/values/one-value.slang"});
}

TEST_CASE("A broken entry is built again") {
  const Workshop shop;
  for (const Route route : {Route::kCpp, Route::kSpirv}) {
    const CompiledKernel made = shop.open().get(scaleRequest(route));
    const fs::path interface = made.binary.parent_path() / "interface.json";
    const std::string goodBinary = kernels::readText(made.binary), goodInterface = kernels::readText(interface);
    std::string flipped = goodBinary, otherOffset = goodInterface;
    flipped[flipped.size() / 2] ^= 1;
    otherOffset.replace(otherOffset.find("\"results\": "), 12, "\"results\": 7");
    const auto heals = [&](const fs::path& path, const std::string& text, std::size_t rebuilt) {
      text.empty() ? void(fs::remove(path)) : writeText(path, text);
      KernelCache cache = shop.open();
      const CompiledKernel again = cache.get(scaleRequest(route));
      CHECK(cache.statistics().compiled == 1);
      CHECK(cache.statistics().rebuilt == rebuilt);
      CHECK(kernels::readText(again.binary).size() == goodBinary.size());
      CHECK(again.interface.resources == made.interface.resources);
      CHECK(shop.open().get(scaleRequest(route)).hash == made.hash);
    };
    heals(made.binary, goodBinary.substr(0, goodBinary.size() / 2), 1);
    heals(made.binary, flipped, 1);
    if (route == Route::kCpp) continue;  // the same code, at three times the compiling
    heals(made.binary, "", 1);
    heals(interface, goodInterface.substr(0, 40), 1);
    heals(interface, otherOffset, 1);
    heals(interface, "", 0);  // as a killed process leaves it: never finished, so not broken
  }
}

TEST_CASE("Processes that fill the cache at once all get whole kernels") {
  const Workshop shop;
  int gate[2];
  REQUIRE(pipe(gate) == 0);
  std::vector<pid_t> children;
  for (int i = 0; i < 4; ++i) {
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child == 0) {
      close(gate[1]);
      char byte;
      const bool opened = read(gate[0], &byte, 1) == 0;  // all start when the parent closes its end
      bool good = opened;
      try {
        for (const Route route : {Route::kSpirv, Route::kCpp}) {
          const CompiledKernel kernel = shop.open().get(scaleRequest(route));
          good = good && fs::file_size(kernel.binary) > 1000 && kernel.interface.resources.size() == 3;
          if (route == Route::kSpirv) good = good && checkSpirv(kernel.binary).empty();
        }
      } catch (...) {
        good = false;
      }
      _exit(good ? 0 : 1);
    }
    children.push_back(child);
  }
  close(gate[0]);
  close(gate[1]);
  for (const pid_t child : children) {
    int status = -1;
    REQUIRE(waitpid(child, &status, 0) == child);
    CHECK(status == 0);
  }
  KernelCache cache = shop.open();
  cache.get(scaleRequest(Route::kCpp));
  cache.get(scaleRequest(Route::kSpirv));
  CHECK(cache.statistics().hits == 2);
  CHECK(countFiles(shop.cache, ".tmp") == 0);
}

TEST_CASE("Many kernels at once come back in order") {
  const Workshop shop;
  KernelCache cache = shop.open();
  std::vector<KernelRequest> requests;
  for (int i = 0; i < 6; ++i)
    requests.push_back(scaleRequest(
        Route::kSpirv, "module variant;\npublic static const int kStep = " + std::to_string(i % 5) + ";\n"));
  std::vector<std::size_t> seen;
  const std::vector<CompiledKernel> kernels = cache.getAll(requests, [&](std::size_t done, std::size_t total) {
    seen.push_back(done);
    CHECK(total == 6);
  });
  CHECK(seen == std::vector<std::size_t>{1, 2, 3, 4, 5, 6});
  for (std::size_t i = 0; i < requests.size(); ++i) CHECK(kernels[i].hash == cache.get(requests[i]).hash);
  CHECK(kernels[0].hash != kernels[1].hash);
  CHECK(kernels[0].hash == kernels[5].hash);
  CHECK(cache.getAll({}).empty());

  requests[3].entry = "nothing";
  CHECK(contains(lineOf(ExitCode::kFailure, [&] { cache.getAll(requests); }), "nothing"));
}

}  // namespace tessera::test
