// What was typed wrong is answered in one line, with exit code 2, and leaves nothing behind.
#include <catch2/catch.hpp>

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
           {"", "a command"},
           {"frobnicate", "frobnicate"},
           {"''", "not expected"},
           {"--frobnicate", "--frobnicate"},
           {"render", "INPUT"},
           {"render two.obj", "nothing to write"},
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
  for (const char* const size :
       {"0x0", "0x16", "16x0", "32769x1", "1x32769", "4294967296x1", "99999999999999999999x1", "-1x4", "4x-1", "16",
        "16x", "x16", "16x16x16", "16X16", "16 x 16", "axb", "1e3x1e3"}) {
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
