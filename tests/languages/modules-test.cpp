// slang/README.md lists the modules that a user's kernel may import; each of them is found by its name from any folder.
#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "fixture.h"
#include "host/kernels/slang-sources.h"
#include "host/kernels/user-kernel.h"
#include "host/plan/stages.h"
#include "tests/support/compare.h"

using namespace tessera;
using namespace tessera::test;

namespace {

namespace fs = std::filesystem;

const fs::path kSlang = TESSERA_SOURCE_DIR "/slang";

struct Listed {
  std::string gives, stages;
};

/// Module -> its line in the table under that heading.
std::map<std::string, Listed> listedModules() {
  static const std::regex row(R"(\| `(\w+)` \| (.*) \| (.*) \|)");
  std::istringstream lines(kernels::readText(kSlang / "README.md"));
  std::map<std::string, Listed> modules;
  bool here = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("## ", 0) == 0) here = line == "## Modules that your kernel may import";
    if (std::smatch match; here && std::regex_match(line, match, row))
      CHECK(modules.emplace(match[1], Listed{match[2], match[3]}).second);
  }
  return modules;
}

/// Imports of all modules that the list has for this stage.
std::string importsFor(const std::string& stage) {
  std::string imports;
  for (const auto& [module, listed] : listedModules())
    if (listed.stages == "every stage" || listed.stages.find("`" + stage + "`") != std::string::npos)
      imports += "import " + module + ";\n";
  return imports;
}

/// Module -> its file, of those that are not generated.
std::map<std::string, fs::path> filesOfModules() {
  static const std::regex declared(R"((?:^|\n)module (\w+);)");
  std::map<std::string, fs::path> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(kSlang))
    if (entry.path().extension() == ".slang") {
      const std::string text = kernels::readText(entry.path());
      if (std::smatch match; std::regex_search(text, match, declared)) files[match[1]] = entry.path();
    }
  return files;
}

}  // namespace

TEST_CASE("The list of modules for users' kernels is whole, and each module gives what the list says") {
  std::set<std::string> listed, there{"settings", "variant"};
  const std::map<std::string, fs::path> files = filesOfModules();
  for (const auto& [module, file] : files) there.insert(module);
  for (const auto& [module, line] : listedModules()) {
    listed.insert(module);
    if (!files.contains(module)) continue;
    const std::string text = kernels::readText(files.at(module));
    static const std::regex quoted(R"(`(\w+)`)");
    std::size_t names = 0;
    for (std::sregex_iterator i(line.gives.begin(), line.gives.end(), quoted), end; i != end; ++i, ++names) {
      INFO(module << ": " << (*i)[1]);
      CHECK(std::regex_search(text, std::regex("public [^;{]*\\b" + (*i)[1].str() + "\\b")));
    }
    INFO(module);
    CHECK(names > 0);
  }
  CHECK(listed == there);
}

TEST_CASE("A user's kernel may import the modules that are listed for its stage") {
  const Bench bench;
  Machine machine = machineWith("spirv", {});
  const Plan tiles = machine.plan(smallScene(), {{"shade", "id"}}),
             items = machine.plan(smallScene(), {{"binning", "none"}, {"shade", "id"}}),
             colours = machine.plan(smallScene(), {{"commit", "depth24+lum8"}, {"shade", "id"}});
  for (const plan::Stage& stage : plan::stages()) {
    INFO(stage.name);
    const Plan& plan = stage.name == "payload" || stage.name == "resolve" ? colours
                       : stage.name == "raster-items"                     ? items
                                                                          : tiles;
    const fs::path file = bench.write(stage.name + "-user.slang", importsFor(stage.name) + "import rasterizer.clip;\n" +
                                                                      kernels::readText(example("by-depth.slang")));
    CHECK_NOTHROW(machine.kernels().get(kernels::requestOf(plan::kernelRequest(stage.name, plan), file)));
  }
}

TEST_CASE("A kernel that imports all modules that are listed for its stage gives the bits of the oracle") {
  const Bench bench;
  for (const std::string stage : {"transform", "raster-tiles"}) {
    const std::string name = stage + ".slang";
    const fs::path file = bench.write(name, importsFor(stage) + kernels::readText(kSlang / "stages" / name));
    for (const char* const route : {"cpp", "spirv"}) {
      INFO(stage << " on " << route);
      Machine machine = machineWith(route, {{stage, file}});
      CHECK(difference(machine.render(smallScene(), {}), oracle::render(smallScene(), {})) == "");
    }
  }
}
