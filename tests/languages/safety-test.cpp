// A user's kernel is native code: its mistakes are a line with its name, and a sweep from elsewhere has to be allowed.
#include <catch2/catch.hpp>

#include "fixture.h"
#include "tests/cli/run-tessera.h"

using namespace tessera::test;
namespace fs = std::filesystem;

namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Renders with an example edited; what stood there before has to stay.
void failsOn(const std::string& device, const std::string& example, const Bench::Edits& edits,
             const std::vector<std::string>& said) {
  Desk desk;
  desk.write("two.obj", twoTriangles());
  desk.write("a.exr", "mine");
  const Bench bench;
  const fs::path kernel = bench.edited(example, edits);
  const auto outcome = desk.tessera("render two.obj --size 24x24 -o a.exr --set shade=id --device " + device +
                                    " --kernel shade=" + kernel.string());
  INFO(outcome.err);
  CHECK(outcome.code == 2);
  CHECK(outcome.complainsOnce());
  CHECK(has(outcome.err, "kernel shade (" + kernel.string() + "): "));
  for (const std::string& part : said) CHECK(has(outcome.err, part));
  CHECK(desk.read("a.exr") == "mine");
}

/// by-depth.slang on the CPU.
void fails(const Bench::Edits& edits, const std::vector<std::string>& said) {
  failsOn("cpu", "by-depth.slang", edits, said);
}
/// by-depth.comp.
void failsInGlsl(const Bench::Edits& edits, const std::string& said) {
  failsOn("vulkan", "by-depth.comp", edits, {"): out of bounds: " + said + "\n"});
}

const std::string kRead = "= depth[pixel]", kMain = "void main()";  // of by-depth.comp
const Bench::Edits kPastColour{{"colour[3 * pixel + channel] =", "colour[3 * pixel + channel + 1] ="}};
/// In groups of more than one thread, which the CPU does not run.
const std::pair<std::string, std::string> kManyThreads{"[numthreads(kThreadsPerGroup, 1, 1)]",
                                                       "[numthreads(64, 1, 1)]"};

}  // namespace

TEST_CASE("A write past a buffer is an error with kernel and index and buffer") {
  fails({{"colour[3 * pixel + channel] =", "colour[3 * pixel + channel + 1] ="}},
        {"index 1728 of 1728 elements of `colour`"});
}

TEST_CASE("A negative index is one") {
  fails({{"depth[pixel]", "depth[int(pixel % 2) - 1]"}}, {"index -1 of 576 elements of `depth`"});
}

TEST_CASE("An index past a group's array is one") {
  fails({{"[shader", "groupshared float few[4];\n[shader"}, {"asfloat(depth[pixel])", "few[pixel % 5]"}},
        {"index 4 of 4 elements of an array"});
}

TEST_CASE("An index of GLSL past a buffer is one") {
  failsInGlsl(kPastColour, "index 1728 of 1728 elements of `colour`");
  failsInGlsl({{kRead, "= depth[pixel + channel]"}}, "index 576 of 576 elements of `depth`");
  failsInGlsl({{kRead, "= depth[int(pixel) - 1]"}}, "index -1 of 576 elements of `depth`");
  failsInGlsl({{kRead, "= depth[100000000]"}}, "index 100000000 of 576 elements of `depth`");
  failsInGlsl({{kRead, "= depth[depth.length()]"}}, "index 576 of 576 elements of `depth`");
}

TEST_CASE("An index of GLSL past an array or a vector is one") {
  failsInGlsl({{kMain, "shared float few[4];\n" + kMain}, {kRead, "= few[pixel % 5]"}},
              "index 4 of 4 elements of `few`");
  failsInGlsl(
      {{kMain, "shared float few[4];\n" + kMain}, {"colour[3 * pixel", "few[pixel % 5] = 1.0, colour[3 * pixel"}},
      "index 4 of 4 elements of `few`");
  failsInGlsl({{"for (uint", "float local[3] = float[](1, 2, depth[pixel]); for (uint"},
               {kRead, "= local[int(pixel % 4) - 1]"}},
              "index -1 of 3 elements of `local`");
  failsInGlsl({{"for (uint", "float local[2][3]; local[pixel % 2][pixel % 4] = 1; for (uint"}},
              "index 3 of 3 elements of an array in `local`");
  failsInGlsl({{kMain, "float pick(float from[3], uint k) { return from[k]; }\n" + kMain},
               {kRead, "= pick(float[](1, 2, depth[pixel]), pixel % 4)"}},
              "index 3 of 3 elements of `from`");
  failsInGlsl({{kMain, "const float table[2] = float[](0, 1);\n" + kMain}, {kRead, "= table[pixel % 3]"}},
              "index 2 of 2 elements of an array in it");
  failsInGlsl({{kMain,
                "struct Corner { uint words[4]; };\n"
                "layout(std430, binding = 3) readonly buffer Corners { Corner corners[]; };\n" +
                    kMain},
               {kRead, "= float(corners[0].words[pixel % 5])"}},
              "index 4 of 4 elements of an array in `corners`");
  failsInGlsl({{kRead, "= vec3(depth[pixel])[pixel % 4]"}}, "index 3 of 3 elements of a vector in it");
  failsInGlsl({{"for (uint", "vec2 pair; pair[pixel % 3] = 1; for (uint"}},
              "index 2 of 2 elements of a vector in `pair`");
  failsInGlsl({{"for (uint", "mat3 turn = mat3(depth[pixel]); for (uint"}, {kRead, "= turn[pixel % 4][channel]"}},
              "index 3 of 3 elements of a matrix in `turn`");
}

TEST_CASE("An index of a group of many threads is one") {
  for (const std::string route : {"spirv", "glsl"}) {
    const std::string device = "vulkan --set route=" + route;
    failsOn(device, "by-depth.slang", {kManyThreads, kPastColour.front()}, {"index 1728 of 1728 elements of `colour`"});
    failsOn(device, "by-depth.slang", {kManyThreads, {"depth[pixel]", "depth[int(pixel % 2) - 1]"}},
            {"index -1 of 576 elements of `depth`"});
    failsOn(
        device, "by-depth.slang",
        {kManyThreads, {"[shader", "groupshared float few[4];\n[shader"}, {"asfloat(depth[pixel])", "few[pixel % 5]"}},
        {"index 4 of 4 elements of `few"});  // Slang's GLSL numbers it
    failsOn(device, "by-row.hlsl", {{"colour[3 * pixel + 2] =", "colour[3 * pixel + 3] ="}},
            {"index 1728 of 1728 elements of `colour`"});
  }
}

TEST_CASE("What a kernel of GLSL writes is checked where ours reads it") {
  Desk desk;
  desk.write("two.obj", twoTriangles());
  const Bench bench;
  // The one tile's entry is a piece that there is not.
  const fs::path kernel = bench.write("insert.comp", R"(#version 460
layout(local_size_x = 64) in;
layout(std430, binding = 1) buffer TileCounts { uint tileCounts[]; };
layout(std430, binding = 2) buffer Entries { uint entries[]; };
layout(std430, binding = 3) buffer Counters { uint counters[]; };
void main() { if (gl_GlobalInvocationID.x == 0) { atomicAdd(counters[0], 0); tileCounts[0] = 1; entries[0] = 12345; } }
)");
  const auto outcome = desk.tessera(
      "render two.obj --size 24x24 --set binning=exact --device vulkan --kernel bin-insert=" + kernel.string());
  INFO(outcome.err);
  CHECK(outcome.code == 2);
  CHECK(outcome.complainsOnce());
  CHECK(has(outcome.err, "tessera: vulkan: kernel raster-tiles: "));
  CHECK(has(outcome.err, "out of bounds: index 12345 of "));
  CHECK(has(outcome.err, " elements of `pieces`; "));
  CHECK(has(outcome.err, "it runs on what kernel bin-insert (" + kernel.string() + ") wrote"));
}

TEST_CASE("A kernel of GLSL that computes addresses cannot be checked and does not run") {
  failsOn("vulkan", "by-depth.comp",
          {{"#version 460\n",
            "#version 460\n#extension GL_EXT_buffer_reference : require\n#extension GL_ARB_gpu_shader_int64 : require\n"
            "layout(buffer_reference, std430) readonly buffer Far { float value; };\n"},
           {kRead, "= Far(uint64_t(pixel)).value"}},
          {"it computes addresses"});
}

TEST_CASE("A kernel of GLSL that is right passes the checks") {
  const Bench bench;
  const fs::path file =
      bench.edited("by-depth.comp", {{"for (uint", "if (pixel >= depth.length()) return; for (uint"}});
  Desk desk;
  desk.write("two.obj", twoTriangles());
  for (const std::string route : {"spirv", "glsl"}) {
    const auto outcome = desk.tessera("render two.obj --size 24x24 --set shade=id,route=" + route +
                                      " --device vulkan -q --kernel shade=" + file.string());
    INFO(outcome.err);
    CHECK(outcome.code == 0);
    CHECK(outcome.err.empty());
  }
  CHECK(desk.tessera("parity two.obj --size 24x24 --device vulkan --kernel transform=" +
                     example("transform.comp").string())
            .code == 0);
}

TEST_CASE("Parity and a sweep say an index of GLSL that is out of range") {
  Desk desk;
  desk.write("two.obj", twoTriangles());
  const Bench bench;
  const fs::path kernel = bench.edited("by-depth.comp", kPastColour);
  const std::string said = "kernel shade (" + kernel.string() + "): out of bounds: index ";
  const auto parity =
      desk.tessera("parity two.obj --size 24x24 --set shade=id --device vulkan --kernel shade=" + kernel.string());
  INFO(parity.err);
  CHECK(parity.code == 2);
  CHECK(parity.complainsOnce());
  CHECK(has(parity.err, said));
  desk.write("sweep.toml",
             "title = \"t\"\nquestion = \"q\"\nsizes = [16]\nrounds = 1\ndevices = [\"vulkan\"]\n[scenes]\n"
             "grid = \"generate:grid\"\n[set]\nshade = \"id\"\n[kernels]\nshade = [\"" +
                 kernel.string() + "\"]\n");
  const auto sweep = desk.tessera("sweep sweep.toml --allow-kernels --out results");
  INFO(sweep.err);
  CHECK(sweep.code == 0);
  CHECK(has(sweep.out + sweep.err, "error: " + said));
  CHECK(has(desk.read("results/rows.jsonl"), said));
}

TEST_CASE("An integer division by zero is a line") {
  fails({{"asfloat(depth[pixel])", "float(pixel / frame.maskWords)"}}, {"division by zero"});
}

TEST_CASE("A sweep's kernels from outside its folder run when that is allowed") {
  Desk desk;
  fs::create_directories(desk.path() / "swept/inner");
  desk.write("swept/sweep.toml", "");
  const auto sweep = [&](const std::string& file) {
    desk.write("swept/sweep.toml",
               "title = \"t\"\nquestion = \"q\"\nsizes = [16]\nrounds = 1\n[scenes]\ngrid = \"generate:grid\"\n"
               "[set]\nshade = \"id\"\n[kernels]\nshade = [\"" +
                   file + "\"]\n");
  };
  // No compiler takes it, so that a line about it tells that it was compiled.
  desk.write("elsewhere.slang", "[numthreads(1, 1, 1)] void f() { not Slang }");
  fs::create_symlink(desk.path() / "elsewhere.slang", desk.path() / "swept/link.slang");
  fs::create_symlink(desk.path(), desk.path() / "swept/up");
  const std::vector<std::string> foreign{"../elsewhere.slang", "link.slang", "up/elsewhere.slang",
                                         "inner/../../elsewhere.slang", (desk.path() / "elsewhere.slang").string()};
  for (const std::string& file : foreign) {
    sweep(file);
    const auto refused = desk.tessera("sweep swept/sweep.toml --out results");
    INFO(file << "\n" << refused.err);
    CHECK(refused.code == 2);
    CHECK(refused.complainsOnce());
    CHECK(has(refused.err, "swept/sweep.toml:10:"));
    CHECK(has(refused.err, "--allow-kernels"));
    CHECK_FALSE(fs::exists(desk.path() / "results"));
  }
  const auto expanded = desk.tessera("expand swept/sweep.toml");
  INFO(expanded.err << expanded.out);
  CHECK(expanded.code == 0);
  CHECK(has(expanded.err, "--allow-kernels"));
  CHECK_FALSE(has(expanded.out + expanded.err, "slangc"));
  CHECK(has(desk.tessera("expand swept/sweep.toml --allow-kernels").out, "slangc"));

  // Beside the sweep, and in a folder of its own below.
  desk.write("swept/inner/mine.slang", "[numthreads(1, 1, 1)] void f() { not Slang }");
  sweep("inner/mine.slang");
  const auto own = desk.tessera("expand swept/sweep.toml");
  CHECK(has(own.out, "slangc"));
  CHECK_FALSE(has(own.err, "--allow-kernels"));
}
