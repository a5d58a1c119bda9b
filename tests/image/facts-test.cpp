// What images say about what they depend on, and that two devices write one file.
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <tessera/image.h>
#include <tessera/input.h>

#include <array>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>

#include "command.h"
#include "host/support/files.h"

using namespace tessera;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

std::string bytesOf(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::map<std::string, std::string> factsOf(const fs::path& path) {
  std::map<std::string, std::string> facts;
  const auto in = OIIO::ImageInput::open(path.string());
  REQUIRE(in);
  for (const auto& attribute : in->spec().extra_attribs)
    if (attribute.name().string().starts_with("tessera:"))
      facts[attribute.name().string().substr(8)] = attribute.get_string();
  return facts;
}

struct Desk : support::TemporaryFolder {
  Desk() : support::TemporaryFolder(support::temporaryRoot(), "tessera-facts-test") {}
  fs::path operator/(const std::string& name) const { return path() / name; }
  void tessera(const std::string& arguments) const {
    const auto outcome = test::run(path(), "'" TESSERA_PROGRAM "' " + arguments);
    INFO(arguments << "\n" << outcome.text);
    REQUIRE(outcome.code == 0);
  }
};

const std::string kRender = "render 'generate:icosphere?level=2' --size 64x64 ";

}  // namespace

TEST_CASE("the CPU and a Vulkan device write the same files byte by byte") {
  const Desk desk;
  const std::string settings = kRender + "--set shade=smooth --attribute z --range -1,1 ";
  desk.tessera(settings + "--threads 1 -o cpu.exr -o cpu.png");
  desk.tessera(settings + "--set tile=16 -o other.exr -o other.png");
  desk.tessera(settings + "--device vulkan -o vulkan.exr -o vulkan.png");
  for (const std::string extension : {".exr", ".png"}) {
    const std::string cpu = bytesOf(desk / ("cpu" + extension));
    CHECK(cpu.size() > 1000);
    CHECK((cpu == bytesOf(desk / ("vulkan" + extension))));
    CHECK((cpu == bytesOf(desk / ("other" + extension))));
  }
}

TEST_CASE("an image says what it depends on in both formats") {
  const Desk desk;
  desk.tessera(kRender + "--attribute z --range -1,1 --set cull=back --set fill=inclusive -o a.exr -o a.png");
  const auto facts = factsOf(desk / "a.exr");
  CHECK(factsOf(desk / "a.png") == facts);
  CHECK(facts.at("attribute") == "z");
  CHECK(facts.at("range") == "-1 1");
  CHECK(facts.at("raster") == "64 x 64");
  CHECK(facts.at("scene").size() == 64);
  CHECK_THAT(facts.at("image"), Contains("cull=back") && Contains("fill=inclusive") && !Contains("tile="));
  CHECK_THAT(facts.at("version"), Contains("0."));
  CHECK(std::count(facts.at("camera").begin(), facts.at("camera").end(), ' ') == 15);
  CHECK_FALSE(facts.contains("approximate"));
  CHECK_FALSE(facts.contains("kernels"));
  desk.tessera(kRender + "--set commit=depth24+lum8 -o b.exr");
  CHECK(factsOf(desk / "b.exr").at("approximate") == "commit=depth24+lum8");
  desk.tessera(kRender + "--device vulkan --kernel 'transform=" TESSERA_SOURCE_DIR
                         "/slang/by-hand/transform.comp' -o k.exr");
  CHECK_THAT(factsOf(desk / "k.exr").at("kernels"), Contains("transform="));
}

TEST_CASE("an image of a scene far from 0 names the camera of the input's coordinates and the origin") {
  const Desk desk;
  std::ofstream(desk / "far.off") << "OFF\n3 1 0\n500000 4500000 10\n500002 4500000 12\n500001 4500003 11\n3 0 1 2\n";
  desk.tessera("render far.off --size 64 -o a.exr");
  const auto facts = factsOf(desk / "a.exr");
  std::istringstream camera(facts.at("camera"));
  std::array<double, 16> m;
  for (double& value : m) REQUIRE(camera >> value);
  const Scene scene = loadInput((desk / "far.off").string(), 64, 64);
  CHECK(facts.at("origin") == fmt::format("{} {} {}", scene.origin.x, scene.origin.y, scene.origin.z));
  CHECK(scene.origin != glm::dvec3(0));
  for (const glm::vec3& position : scene.positions) {
    const glm::dvec3 p(position), input = p + scene.origin;  // exact
    for (std::size_t r = 0; r < 16; r += 4) {
      const Matrix& f = scene.clipFromObject;
      // Entries are below 4 and coordinates below 2^23: each of some ten operations rounds by at most 2^25 * 2^-53.
      CHECK(m[r] * input.x + m[r + 1] * input.y + m[r + 2] * input.z + m[r + 3] ==
            Approx(f[r] * p.x + f[r + 1] * p.y + f[r + 2] * p.z + f[r + 3]).epsilon(0).margin(10 * 0x1p-28));
    }
  }
}

TEST_CASE("compare names what two images do not have in common and keeps it apart from the pixels") {
  const Desk desk;
  desk.tessera(kRender + "-o a.exr");
  desk.tessera(kRender + "--attribute z --range -1,1 -o b.exr");
  const auto outcome = test::run(desk.path(), "'" TESSERA_PROGRAM "' compare a.exr b.exr");
  INFO(outcome.text);
  CHECK(outcome.code == 0);
  CHECK_THAT(outcome.text, Contains("range: - in a.exr, -1 1 in b.exr") && Contains("\nequal\n"));
}

TEST_CASE("images go to pipes and to stdout with their format named") {
  const Desk desk;
  desk.tessera(kRender + "-o a.exr -o a.png");
  desk.tessera(kRender + "-o png:- >out.png 2>err");
  CHECK((bytesOf(desk / "out.png") == bytesOf(desk / "a.png")));
  CHECK_THAT(bytesOf(desk / "err"), Contains("wrote png:-"));
  const auto piped = test::run(desk.path(), "mkfifo pipe && { cat pipe >out.exr & '" TESSERA_PROGRAM "' " + kRender +
                                                "-o exr:pipe; wait; test -p pipe; }");
  INFO(piped.text);
  CHECK(piped.code == 0);
  CHECK((bytesOf(desk / "out.exr") == bytesOf(desk / "a.exr")));
  const auto unnamed = test::run(desk.path(), "'" TESSERA_PROGRAM "' " + kRender + "-o pipe");
  CHECK(unnamed.code == 2);
  CHECK_THAT(unnamed.text, Contains("pipe") && Contains("png:"));
  const auto twice = test::run(desk.path(), "'" TESSERA_PROGRAM "' " + kRender + "-o png:- --json - >out");
  CHECK(twice.code == 2);
}
