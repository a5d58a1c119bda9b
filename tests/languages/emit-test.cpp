// tessera kernels --emit: each stage of a variant in a file of its own.
#include "host/kernels/emit.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <set>

#include "fixture.h"
#include "host/kernels/spirv.h"
#include "tests/cli/run-tessera.h"

using namespace tessera::test;

namespace {

/// What each target's text has and the others' have not.
const std::map<std::string, std::string> kSigns{{"glsl", "#version 450"},     {"cpp", "tesseraAtomicAdd"},
                                                {"wgsl", "@compute"},         {"hlsl", "[numthreads(64, 1, 1)]"},
                                                {"metal", "[[kernel]] void"}, {"cuda", "extern \"C\" __global__ void"}};

/// How each target says where a buffer goes.
const std::map<std::string, std::string> kPlaces{{"spirv", "binding"}, {"glsl", "binding"},  {"cpp", "offset"},
                                                 {"wgsl", "binding"},  {"hlsl", "register"}, {"metal", "buffer"},
                                                 {"cuda", "offset"}};

void checkManifest(const Desk& desk, const std::string& target) {
  const auto manifest = nlohmann::json::parse(desk.read("made/here/manifest.json"));
  CHECK(manifest.at("target") == target);
  CHECK(manifest.at("stages").size() == 4);
  CHECK(manifest.at("commands").size() > 4);
  for (const auto& stage : manifest.at("stages")) {
    const std::string text = desk.read("made/here/" + stage.at("file").get<std::string>());
    CHECK(stage.at("workgroupSize").size() == 3);
    CHECK_FALSE(stage.at("bindings").empty());
    for (const auto& binding : stage.at("bindings")) {
      INFO(binding.dump());
      CHECK(binding.at("place").contains(kPlaces.at(target)));
      if (target != "spirv") CHECK(contains(text, binding.at("inFile").get<std::string>()));
    }
  }
}

}  // namespace

TEST_CASE("Every stage of a variant is written for every target") {
  for (const auto& target : tessera::kernels::emitTargets()) {
    Desk desk;
    const auto outcome =
        desk.tessera("kernels --emit " + target.name + " made/here --set commit=two-pass --set shade=none");
    INFO(target.name << "\n" << outcome.err << outcome.out);
    REQUIRE(outcome.code == 0);
    for (const std::string stage : {"clear", "transform", "setup", "raster-items"}) {
      const std::string file = "made/here/" + stage + "." + target.extension;
      CHECK(contains(outcome.out, file));
      if (target.name == "spirv")
        CHECK(!tessera::kernels::spirvInstructions(tessera::kernels::readSpirv(desk.path() / file)).empty());
      else
        CHECK(contains(desk.read(file).substr(0, 1u << 20), kSigns.at(target.name)));
    }
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(desk.path() / "made/here"))
      names.insert(entry.path().filename().string());
    CHECK(names.size() == 6);  // manifest.json and buffers/ beside them
    checkManifest(desk, target.name);
  }
}

TEST_CASE("The stages are those that the input needs") {
  Desk desk;
  desk.write("two.obj", twoTriangles());
  REQUIRE(desk.tessera("kernels --emit hlsl plain two.obj").code == 0);
  REQUIRE(desk.tessera("kernels --emit hlsl more two.obj --attribute x --set shade=flat").code == 0);
  for (const std::string stage : {"shade.hlsl", "attribute.hlsl"}) {
    CHECK_FALSE(std::filesystem::exists(desk.path() / "plain" / stage));
    CHECK(std::filesystem::exists(desk.path() / "more" / stage));
  }
}

TEST_CASE("Files that stand in the folder already stay unless they are a stage's") {
  Desk desk;
  desk.write("notes.txt", "mine");
  desk.write("transform.hlsl", "old");
  REQUIRE(desk.tessera("kernels --emit hlsl . --set shade=none").code == 0);
  CHECK(desk.read("notes.txt") == "mine");
  CHECK(contains(desk.read("transform.hlsl"), "numthreads"));
}

TEST_CASE("What cannot be written is said and told by the exit code") {
  Desk desk;
  desk.write("file", "");
  const std::vector<std::tuple<std::string, int, std::string>> mistakes{
      {"--emit spirv", 2, "--emit"},
      {"--emit fortran out", 2, "wgsl"},
      {"--emit spirv file", 2, "file"},
      {"--emit spirv out --prebuild", 2, "--prebuild"},
      {"--emit spirv out --set tile=7", 2, "tile"},
      {"--emit wgsl out --set wide=native", 4, "WGSL"},
      {"--emit spirv out --device cpu", 2, "--device"},
      {"--emit spirv out --size 64x64", 2, "INPUT"},
      {"--emit spirv out --attribute z", 2, "INPUT"},
      {"--prebuild --set tile=8", 2, "--emit"}};
  for (const auto& [arguments, code, named] : mistakes) {
    const auto outcome = desk.tessera("kernels " + arguments);
    INFO(arguments << "\n" << outcome.err << outcome.out);
    CHECK(outcome.code == code);
    CHECK(outcome.complainsOnce());
    CHECK(contains(outcome.err, named));
    CHECK(desk.names() == std::vector<std::string>{"file"});
  }
}
