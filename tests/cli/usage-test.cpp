// What was typed wrong is answered in one line, with exit code 2, and leaves nothing behind.
#include <catch2/catch.hpp>
#include <sstream>

#include "run-tessera.h"

using tessera::test::Desk;

namespace {

struct Mistake {
  const char* arguments;
  const char* named;  ///< what the line must name
};

void check(const Desk& desk, const Mistake& mistake) {
  const auto before = desk.names();
  const auto outcome = desk.tessera(mistake.arguments);
  INFO("tessera " << mistake.arguments << "\n" << outcome.err << outcome.out);
  CHECK(outcome.code == 2);
  CHECK(outcome.complainsOnce());
  CHECK(outcome.err.find(mistake.named) != std::string::npos);
  CHECK(outcome.out.empty());
  CHECK(desk.names() == before);
}

}  // namespace

TEST_CASE("Commands and options that do not exist are refused") {
  Desk desk;
  desk.write("two.obj", tessera::test::twoTriangles());
  for (const Mistake& mistake : std::initializer_list<Mistake>{
           {"frobnicate", "there are render"},
           {"''", "no command ''"},
           {"--frobnicate", "--frobnicate"},
           {"render", "INPUT"},
           {"render two.obj --set tile=12", "tile=12"},
           {"render two.obj -o a.png --set tile=8 --set tile=16", "tile is set twice"},
           {"render two.obj -o a.png --frobnicate", "--frobnicate"},
           {"render two.obj extra.obj -o a.png", "extra.obj"},
           {"render two.obj -o", "--output"},
           {"render two.obj -o a.png --device cpu --device cpu", "--device"},
           {"render two.obj -o a.png --repeat 0", "--repeat"},
           {"render two.obj -o a.png --repeat -1", "--repeat"},
           {"render two.obj -o a.png --repeat many", "--repeat"},
           {"render two.obj -o a.png --threads 0", "--threads"},
           {"render two.obj -o a.png --threads x", "--threads"},
           {"render two.obj -o a.png --attribute quality", "there are x, y, z"},
           {"parity two.obj --attribute quality", "there are x, y, z"},
           {"render two.obj -o a.png --range 0,1", "--attribute"},
           {"render two.obj -o a.png --attribute x --range 0", "-1,2.5"},
           {"render two.obj -o a.png --attribute x --range 1,1", "-1,2.5"},
           {"render two.obj -o a.png --attribute x --range 0,inf", "-1,2.5"},
           {"render two.obj -o a.png --attribute x --set commit=count", "commit=count keeps no ids"},
           {"compare a.exr", "B"},
           {"kernels", "--prebuild"},
           {"variants --json --markdown", "--json"},
       })
    check(desk, mistake);
}

TEST_CASE("Axes and values that do not exist are refused and those there are named") {
  Desk desk;
  desk.write("two.obj", tessera::test::twoTriangles());
  for (const Mistake& mistake : std::initializer_list<Mistake>{
           {"render two.obj -o a.png --set colour=red", "tile"},
           {"render two.obj -o a.png --set tile=7", "16"},
           {"render two.obj -o a.png --set tile", "tile"},
           {"render two.obj -o a.png --set tile=", "tile"},
           {"render two.obj -o a.png --set =8", "tile"},
           {"render two.obj -o a.png --set ''", "axis=value"},
           {"plan two.obj --set tile=7", "16"},
           {"parity two.obj --set tile=7", "16"},
       })
    check(desk, mistake);
}

TEST_CASE("Sizes of 0 and beyond 32768 are refused and so is what is no size") {
  Desk desk;
  desk.write("two.obj", tessera::test::twoTriangles());
  for (const char* const size : {"0x0", "0x16", "16x0", "32769x1", "1x32769", "4294967296x1", "99999999999999999999x1",
                                 "-1x4", "4x-1", "0", "16x", "x16", "16x16x16", "16 x 16", "axb", "1e3x1e3"}) {
    const auto arguments = std::string("render two.obj -o a.png --size '") + size + "'";
    check(desk, {arguments.c_str(), "32768"});
  }
}

TEST_CASE("Devices that are not there are refused") {
  Desk desk;
  desk.write("two.obj", tessera::test::twoTriangles());
  for (const Mistake& mistake : std::initializer_list<Mistake>{
           {"render two.obj -o a.png --device toaster", "toaster"},
           {"render two.obj -o a.png --device ''", "--device"},
           {"render two.obj -o a.png --device vulkan:", "vulkan:"},
           {"render two.obj -o a.png --device vulkan:97", "97"},
           {"render two.obj -o a.png --device vulkan:no-such-name", "no-such-name"},
           {"render two.obj -o a.png --device cpu:0", "cpu:0"},
           {"plan two.obj --device vulkan:97", "97"},
           {"parity two.obj --device cpu --device vulkan:97", "97"},
           {"kernels --prebuild --device vulkan:97", "97"},
           {"render two.obj -o a.png --device vulkan --threads 2", "--threads"},
       })
    check(desk, mistake);
}

TEST_CASE("Help and version answer on stdout") {
  Desk desk;
  for (const char* const arguments :
       {"--help", "--version", "render --help", "parity --help", "compare --help", "plan --help", "devices --help",
        "variants --help", "kernels --help", "sweep --help"}) {
    const auto outcome = desk.tessera(arguments);
    INFO("tessera " << arguments);
    CHECK(outcome.code == 0);
    CHECK(outcome.err.empty());
    CHECK_FALSE(outcome.out.empty());
  }
  const std::string help = desk.tessera("render --help").out;
  for (const char* const word : {"icosphere", "tile", "Examples", "vulkan:N"})
    CHECK(help.find(word) != std::string::npos);
}

TEST_CASE("What was mistyped is answered by what may have been meant") {
  Desk desk;
  desk.write("two.obj", tessera::test::twoTriangles());
  for (const Mistake& mistake : std::initializer_list<Mistake>{
           {"rendr two.obj", "did you mean render?"},
           {"Parity two.obj", "did you mean parity?"},
           {"help varaints", "did you mean variants?"},
           {"diff a.exr b.exr", "did you mean compare?"},
           {"two.obj", "did you mean 'tessera render two.obj'?"},
           {"mesh:cube", "did you mean 'tessera render mesh:cube'?"},
           {"render two.obj --otput a.png", "did you mean --output?"},
           {"render two.obj --SIZE 8", "did you mean --size?"},
           {"render two.obj --width 8", "did you mean --size?"},
           {"render two.obj --tile 8", "did you mean --set tile=VALUE?"},
           {"render two.obj --set tlie=8", "did you mean tile?"},
           {"render two.obj --set sub_pixel=4", "did you mean sub-pixel?"},
           {"render two.obj --set commit=twopass", "did you mean two-pass?"},
           {"render two.obj --set commit=depth24", "did you mean depth24+lum8?"},
           {"render two.obj --set tile", "tile=8 or 16 or 32 or 64 would be right"},
           {"render two.obj --set capacity", "capacity=16 to capacity=65536"},
           {"render two.obj --set tile=8,16", "'16' has no axis"},
           {"render two.obj --kernel shde=x.slang", "did you mean shade?"},
           {"render two.obj --device CPU", "did you mean cpu?"},
           {"render two.obj --device gpu", "did you mean vulkan?"},
           {"render two.obj --device llvmpipe", "did you mean vulkan:llvmpipe?"},
           {"render two.obj --device vulkan0", "did you mean vulkan:0?"},
           {"render two.obj --device toaster", "there are cpu, vulkan:0 ("},
           {"render two.obj --repeat 1e3", "1e3 is no whole number from 1 to 1000000"},
           {"render two.obj --threads 0", "0 is no whole number from 1 to 4096"},
           {"render", "for example: tessera render mesh:refined_elephant"},
           {"render generate:", "There are icosphere, torus"},
           {"render generate:icosfere", "did you mean icosphere?"},
           {"render 'generate:torus?ring=5'", "did you mean rings?"},
           {"kernels --emit wsgl out", "did you mean wgsl?"},
       })
    check(desk, mistake);
}

TEST_CASE("The program alone says what to type and exits with 2") {
  const auto outcome = Desk().tessera("");
  CHECK(outcome.code == 2);
  CHECK(outcome.out.empty());
  for (const char* const word : {"usage: tessera COMMAND", "parity", "tessera render mesh:", "tessera help COMMAND"})
    CHECK(outcome.err.find(word) != std::string::npos);
}

TEST_CASE("Help and version can be asked for in any of the usual ways") {
  Desk desk;
  const auto said = [&](const char* arguments) {
    const auto outcome = desk.tessera(arguments);
    INFO("tessera " << arguments << "\n" << outcome.err);
    CHECK(outcome.code == 0);
    CHECK(outcome.err.empty());
    return outcome.out;
  };
  const std::string version = said("--version"), help = said("--help"), render = said("render --help");
  CHECK(version.starts_with("tessera "));
  for (const char* const other : {"-V", "version"}) CHECK(said(other) == version);
  for (const char* const other : {"-h", "help"}) CHECK(said(other) == help);
  for (const char* const other : {"render -h", "help render", "--help render", "render two.obj --help"})
    CHECK(said(other) == render);
  CHECK(render != help);
}

TEST_CASE("Help is wrapped to the columns there are and names no option of another") {
  Desk desk;
  for (const char* const command : {"render", "parity", "compare", "plan", "devices", "variants", "kernels", "expand",
                                    "sweep", "report", "help", "version", ""})
    for (const unsigned columns : {60u, 100u}) {
      const auto outcome = desk.tessera(std::string(command) + " --help", "COLUMNS=" + std::to_string(columns));
      CHECK(outcome.out.find("Excludes:") == std::string::npos);
      std::istringstream lines(outcome.out);
      for (std::string line; std::getline(lines, line);) {
        INFO(command << " at " << columns << ": " << line);
        // A command to be pasted stays on one line.
        CHECK((line.size() <= columns || line.starts_with("  tessera ")));
      }
    }
}

TEST_CASE("Settings of several axes fit into one option") {
  Desk desk;
  desk.write("two.obj", tessera::test::twoTriangles());
  const std::string apart = desk.tessera("plan two.obj --set tile=8 --set commit=two-pass --set binning=queue").out;
  CHECK(apart.find("tile=8") != std::string::npos);
  CHECK(desk.tessera("plan two.obj --set tile=8,commit=two-pass --set binning=queue").out == apart);
  CHECK(desk.tessera("plan two.obj --set 'tile=8 commit=two-pass binning=queue'").out == apart);  // as plan prints it
  check(desk, {"plan two.obj --set tile=8,tile=16", "tile is set twice"});
  CHECK(desk.tessera("plan two.obj --set 'tile=8, commit=two-pass, binning=queue'").out == apart);
}

TEST_CASE("A size is one number or two") {
  Desk desk;
  desk.write("two.obj", tessera::test::twoTriangles());
  const auto size = [&](const std::string& text) {
    const auto outcome = desk.tessera("render two.obj --size " + text);
    INFO(outcome.err);
    CHECK(outcome.code == 0);
    return outcome.out.substr(0, outcome.out.find(", ", outcome.out.find(" triangles, ") + 12));
  };
  CHECK(size("64") == "two: 2 triangles, 64 x 64");
  CHECK(size("64x48") == "two: 2 triangles, 64 x 48");
  CHECK(size("64X48") == "two: 2 triangles, 64 x 48");
}

TEST_CASE("Without an output render prints times and writes nothing and quiet prints nothing") {
  Desk desk;
  desk.write("two.obj", tessera::test::twoTriangles());
  const auto once = desk.tessera("render two.obj --size 64");
  CHECK(once.code == 0);
  CHECK(once.out.find("times of one frame") != std::string::npos);
  const auto many = desk.tessera("render two.obj --size 64 --repeat 9");
  CHECK(many.out.find("medians of 9 frames; frame took ") != std::string::npos);
  CHECK(many.out.find("its median is ") != std::string::npos);
  CHECK(desk.names() == std::vector<std::string>{"two.obj"});
  for (const char* const quiet : {"render two.obj --size 64 -q", "parity two.obj --size 64 --quiet --device cpu"}) {
    const auto outcome = desk.tessera(quiet);
    CHECK(outcome.code == 0);
    CHECK(outcome.out + outcome.err == "");
  }
  CHECK(desk.tessera("render none.obj -q").complainsOnce());
}
