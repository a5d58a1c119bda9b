// --kernel on the command line: what is refused, what the row says, and that parity decides.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <regex>

#include "fixture.h"
#include "tests/cli/run-tessera.h"

using namespace tessera::test;

namespace {

std::string option(const std::string& stage, const std::filesystem::path& file) {
  return " --kernel " + stage + "='" + file.string() + "'";
}

}  // namespace

TEST_CASE("Kernel files that are typed wrong are refused in a line") {
  Desk desk;
  desk.write("two.obj", twoTriangles());
  desk.write("empty.slang", "");
  desk.write("empty.txt", "");
  const std::vector<std::pair<std::string, std::string>> mistakes{
      {"--kernel transform", "STAGE=FILE"},
      {"--kernel colour=empty.slang", "transform"},
      {"--kernel transform=none.slang", "no such file"},
      {"--kernel transform=empty.txt", ".comp"},
      {"--kernel transform=empty.slang --kernel transform=empty.slang", "already"},
      {"--kernel transform=empty.slang", "no compute entry point"},
      {"--kernel project=empty.slang", "does not run"}};
  for (const auto& [arguments, named] : mistakes)
    for (const std::string command : {"render two.obj -o a.png --size 16x16 ", "parity two.obj --size 16x16 "}) {
      const auto outcome = desk.tessera(command + arguments);
      INFO(command << arguments << "\n" << outcome.err);
      CHECK(outcome.code == 2);
      CHECK(outcome.complainsOnce());
      CHECK(contains(outcome.err, named));
      CHECK(outcome.out.empty());
    }
  CHECK(desk.names() == std::vector<std::string>{"empty.slang", "empty.txt", "two.obj"});
}

TEST_CASE("The row says which file ran") {
  Desk desk;
  desk.write("two.obj", twoTriangles());
  std::filesystem::copy_file(example("transform.comp"), desk.path() / "mine.comp");
  const std::string render = "render two.obj --size 32x32 --device vulkan --set route=spirv --json ";
  REQUIRE(desk.tessera(render + "own.json").code == 0);
  const auto outcome = desk.tessera(render + "mine.json --kernel transform=mine.comp");
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  const auto own = nlohmann::json::parse(desk.read("own.json")), mine = nlohmann::json::parse(desk.read("mine.json"));
  CHECK_FALSE(own.contains("kernel_files"));
  REQUIRE(mine.at("kernel_files").size() == 1);
  const auto& file = mine.at("kernel_files").at("transform");
  CHECK(file.at("file") == "mine.comp");
  CHECK(std::regex_match(file.at("sha256").get<std::string>(), std::regex("[0-9a-f]{64}")));
  CHECK(mine.at("variant") == own.at("variant"));
  const auto &kernels = mine.at("provenance").at("kernels"), &before = own.at("provenance").at("kernels");
  CHECK(kernels.at("transform") != before.at("transform"));
  CHECK(kernels.at("setup") == before.at("setup"));
  CHECK(mine.at("time_ns").at("stages").contains("transform"));

  desk.write("mine.comp", desk.read("mine.comp") + "// edited\n");
  REQUIRE(desk.tessera(render + "edited.json --kernel transform=mine.comp").code == 0);
  const auto edited = nlohmann::json::parse(desk.read("edited.json"));
  CHECK(edited.at("kernel_files").at("transform").at("sha256") != file.at("sha256"));
  CHECK(edited.at("provenance").at("kernels").at("transform") != kernels.at("transform"));
}

TEST_CASE("Parity decides about a kernel") {
  Desk desk;
  desk.write("two.obj", twoTriangles());
  const std::string parity = "parity two.obj --size 32x32 --device vulkan --set route=spirv";
  CHECK(desk.tessera(parity + option("transform", example("transform.comp"))).code == 0);
  CHECK(
      desk.tessera("parity two.obj --size 32x32 --device cpu" + option("transform", example("transform.comp"))).code ==
      4);
  const Bench bench;
  const auto wrong = bench.edited("transform.comp", {{"precise const float shifted = s - 0.5;", "float shifted = s;"},
                                                     {"return n + (", "return 300 + n + ("}});
  const auto outcome = desk.tessera(parity + option("transform", wrong));
  CHECK(outcome.code == 5);
  CHECK(contains(outcome.out, "DIFFERENT"));
}

TEST_CASE("A kernel that leaves rounding to the driver is warned about and runs") {
  Desk desk;
  desk.write("two.obj", twoTriangles());
  const Bench bench;
  const auto careless = bench.edited("transform.comp", {{"precise vec4 c;", "vec4 c;"}});
  const std::string render = "render two.obj --size 32x32 --device vulkan -o a.exr";
  for (int run = 0; run < 2; ++run) {  // the second time it is found compiled
    const auto outcome = desk.tessera(render + option("transform", careless));
    CHECK(outcome.code == 0);
    CHECK(contains(outcome.err, "warning: kernel transform ("));
    CHECK(contains(outcome.err, "NoContraction"));
  }
  CHECK(desk.tessera(render + option("transform", example("transform.comp"))).err.find("warning") == std::string::npos);
}
