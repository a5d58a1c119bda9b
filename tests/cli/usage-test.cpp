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
           {"render two.obj -o a.png --set ''", "AXIS=VALUE"},
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
        "variants --help", "meshes --help", "kernels --help", "sweep --help"}) {
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

TEST_CASE("An option that does not exist is named before what is missing and help of what is no command is none") {
  Desk desk;
  desk.write("two.obj", tessera::test::twoTriangles());
  for (const Mistake& mistake : std::initializer_list<Mistake>{
           {"render --hlep", "no option --hlep; did you mean --help?"},
           {"render two.obj extra.obj --otput a.png", "no option --otput; did you mean --output?"},
           {"render --otput a.png --threads 0", "no option --otput"},
           {"render two.obj --hlep -o", "no option --hlep"},
           {"sweep --qick", "no option --qick; did you mean --quick?"},
           {"inspect --help", "no command 'inspect'"},
           {"rendr --help", "did you mean render?"},
           {"--help rendr", "did you mean render?"},
           {"rendr --version", "did you mean render?"},
           {"--hlep --help", "no option --hlep"},
           {"--hlep render two.obj", "tessera: no option --hlep"},
           {"-q render two.obj", "'tessera render -q ...' would be right"},
           {"frobnicate render two.obj", "no command 'frobnicate'"},
       })
    check(desk, mistake);
}

TEST_CASE("What an option wants is said in our own words") {
  Desk desk;
  desk.write("two.obj", tessera::test::twoTriangles());
  const std::initializer_list<Mistake> mistakes{
      {"render two.obj --size 64 --size 32", "--size is given twice, as 64 and as 32; once would be right"},
      {"render two.obj --repeat 1 --repeat 2 --repeat 3", "--repeat is given 3 times, as 1 and as 2 and as 3"},
      {"render two.obj --device cpu --device cpu", "--device is given twice"},
      {"kernels --emit wgsl a --emit glsl b", "--emit is given twice, as wgsl a and as glsl b"},
      {"expand a.toml --devices cpu --devices cpu", "--devices is given twice"},
      {"render two.obj -o", "--output: IMAGE is missing: image: .png"},
      {"kernels --emit", "--emit: TARGET DIR is missing"},
      {"kernels --emit wgsl", "for example: tessera kernels --emit wgsl out/wgsl"},
      {"compare a.exr", "for example: tessera compare cpu.exr gpu.exr"},
      {"render two.obj --range 0,1", "--range is of use only with --attribute NAME, which is missing"},
      {"variants --json --markdown", "--json and --markdown do not go together"},
      {"kernels --prebuild --emit wgsl out", "do not go together"},
      {"render two.obj -o --size 64", "--output: IMAGE is missing: what follows is the option --size"},
      {"render two.obj --json -q", "--json: FILE is missing: what follows is the option -q"},
      {"render two.obj -q=5", "-q=5: it takes no value; -q alone would be right"},
      {"render two.obj --error=no", "--error alone would be right"},
      {"render two.obj --json= -q", "--json=: nothing follows the =; FILE would be right"},
      {"render two.obj -o=a.png", "takes its value without =; -o a.png would be right"},
  };
  for (const Mistake& mistake : mistakes) {
    check(desk, mistake);
    const std::string said = desk.tessera(mistake.arguments).err;
    INFO(said);
    for (const char* const raw : {"required", "Required", "At Most", "At Least", "Expected", "excludes", "requires",
                                  "Could not convert", "not expected", "flag override", "should be true"})
      CHECK(said.find(raw) == std::string::npos);
  }
  for (const char* const command : {"compare", "render", "kernels", "sweep", "expand"}) {
    const std::string help = desk.tessera(std::string(command) + " --help", "COLUMNS=100").out;
    INFO(help);
    for (const char* const raw : {"SIZE:", "[b, kb", "TEXT", "UINT", "FLOAT", "INT in", " ..."})
      CHECK(help.find(raw) == std::string::npos);
  }
}

TEST_CASE("A value that says nothing is refused in every option that takes one") {
  Desk desk;
  desk.write("two.obj", tessera::test::twoTriangles());
  for (const char* const arguments : {"render ''",
                                      "render two.obj -o ''",
                                      "render two.obj --size ''",
                                      "render two.obj --device ''",
                                      "render two.obj --set ''",
                                      "render two.obj --attribute ''",
                                      "render two.obj --attribute x --range ''",
                                      "render two.obj --kernel ''",
                                      "render two.obj --threads ''",
                                      "render two.obj --repeat ''",
                                      "render two.obj --json ''",
                                      "parity two.obj --replay ''",
                                      "parity two.obj --json ''",
                                      "compare '' b.exr",
                                      "compare a.exr b.exr -o ''",
                                      "compare a.exr b.exr --tolerance ''",
                                      "compare a.exr b.exr --allow ''",
                                      "compare a.exr b.exr --at-most ''",
                                      "compare a.exr b.exr --max-unpacked ''",
                                      "kernels --emit wgsl ''",
                                      "sweep '' --out new",
                                      "sweep a.toml --out ''",
                                      "sweep a.toml --out new --job ''",
                                      "expand a.toml --devices ''",
                                      "expand a.toml --rounds ''",
                                      "report ''",
                                      "report . --out ''",
                                      "report . --export ''",
                                      "help ''",
                                      "completion ''"})
    check(desk, {arguments, "the value is empty"});
}

TEST_CASE("Lists have something on both sides of a comma") {
  Desk desk;
  desk.write("two.obj", tessera::test::twoTriangles());
  for (const char* const list :
       {"tile=8,,", "tile=8,", ",tile=8", ",", "' '", "tile=8,,cull=back", "'tile=8, ,cull=back'"})
    check(desk, {(std::string("plan two.obj --set ") + list).c_str(), "nothing is "});
  for (const char* const list : {"cpu,", ",", ",cpu", "cpu,,vulkan"})
    check(desk, {(std::string("expand a.toml --devices ") + list).c_str(), "nothing is on one side of a comma"});
}

TEST_CASE("Numbers that an option cannot mean are refused") {
  Desk desk;
  desk.write("two.obj", tessera::test::twoTriangles());
  const auto each = [&](const std::string& before, std::initializer_list<const char*> values, const char* named) {
    for (const char* const value : values) check(desk, {(before + value).c_str(), named});
  };
  const char* const kNumbers[] = {"--repeat", "--threads"};
  for (const std::string option : kNumbers)
    each("render two.obj " + option + " ",
         {"-1", "0", "1.5", "1e3", "nan", "inf", "3x", "' 3'", "+3", "99999999999999999999"},
         "is no whole number from 1 to");
  each("expand a.toml --rounds ", {"-1", "0", "1001", "2x", "nan"}, "is no whole number from 1 to 1000");
  each("render two.obj --attribute x --range ",
       {"0", "1,1", "nan,1", "0,inf", "0,1e39", "-3e38,3e38", "0,1x", "0,1,2", ",", "0,"}, "not a range");
  const std::string compare = "compare a.exr b.exr ";
  for (const std::string option : {"--tolerance ", "--at-most "}) {
    each(compare + option, {"depth=-1", "depth=nan", "depth=inf", "depth=1e999", "depth=", "depth=1x", "depth=ulp"},
         "not a number from 0 up");
    each(compare + option, {"depth=1.5ulp"}, "not a whole number of steps");
    each(compare + option, {"depth=1 "}, "a.exr");
    check(desk, {(compare + option + "depth=1 " + option + "depth=2").c_str(), "depth is given as a number twice"});
    check(desk, {(compare + option + "depth=1ulp " + option + "depth=1ulp").c_str(),
                 "depth is given in float32 steps twice"});
  }
  each(compare + "--allow ", {"-1", "nan", "inf", "%", "1x", "1%%", "-1%"}, "not a number from 0 up");
  each(compare + "--allow ", {"101%", "100.1%", "1e9%"}, "more than all pixels");
  each(compare + "--allow ", {"1.5", "0.1"}, "not a whole number of pixels");
  each(
      compare + "--max-unpacked ",
      {"-1", "-1K", "0", "0G", "nan", "inf", "1.5G", "8Q", "8GX", "'8 G B'", "K", "16E", "20000000000G", "1e9", "0x10"},
      "not a size from 1 byte");
  each(compare + "--max-unpacked ", {"8", "8b", "8K", "8kb", "8KiB", "'8 G'", "15E"},
       "a.exr: ");  // the first that it misses
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
  for (const char* const command : {"render", "parity", "compare", "plan", "devices", "variants", "meshes", "kernels",
                                    "expand", "sweep", "report", "help", "version", ""})
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
  for (const char* const asked : {"", " --set binning=queue", " --set binning=none", " --set commit=depth24+lum8"}) {
    const std::string plan = std::string("plan two.obj") + asked, said = desk.tessera(plan).out;
    const std::string variant = said.substr(said.find("\nvariant: ") + 10);
    REQUIRE(variant.find('=') != variant.npos);
    const auto again = desk.tessera("plan two.obj --set '" + variant.substr(0, variant.find('\n')) + "'");
    INFO(again.err);
    CHECK(again.code == 0);
    CHECK(again.out.ends_with("\nvariant: " + variant));
  }
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

TEST_CASE("Quiet commands say nothing of their progress or of what they did while their kernels are compiled") {
  Desk desk;
  desk.write("two.obj", tessera::test::twoTriangles());
  desk.write("tile.toml",
             "title = \"T\"\nquestion = \"Q?\"\nsizes = [16]\nrounds = 1\ndevices = [\"cpu\"]\n"
             "[scenes]\nball = \"generate:icosphere?level=1\"\n[axes]\ntile = [8]\n");
  REQUIRE(desk.tessera("render two.obj --size 16 -o a.exr").code == 0);
  REQUIRE(desk.tessera("render two.obj --size 16 -o b.exr --set shade=id,cull=front").code == 0);
  for (const auto& [arguments, code] :
       std::initializer_list<std::pair<const char*, int>>{{"sweep tile.toml --out cold -q", 0},
                                                          {"compare a.exr a.exr -q", 0},
                                                          {"compare a.exr b.exr -o c.png --quiet", 5},
                                                          {"kernels --emit spirv out -q", 0}}) {
    const auto outcome = desk.tessera(arguments, "TESSERA_CACHE=$PWD/cache");
    INFO("tessera " << arguments);
    CHECK(outcome.code == code);
    CHECK(outcome.out + outcome.err == "");
  }
  CHECK(desk.read("c.png").starts_with("\x89PNG"));
  for (const char* const asks : {"expand tile.toml -q", "plan two.obj -q", "compare a.exr b.exr -q --json -"}) {
    const auto outcome = desk.tessera(asks);  // what was asked for is said
    INFO("tessera " << asks << "\n" << outcome.err);
    CHECK(outcome.err.empty());
    CHECK_FALSE(outcome.out.empty());
  }
}
