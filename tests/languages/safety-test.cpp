// A user's kernel is native code: its mistakes are a line with its name, and a sweep from elsewhere has to be allowed.
#include <catch2/catch.hpp>

#include "fixture.h"
#include "tests/cli/run-tessera.h"

using namespace tessera::test;
namespace fs = std::filesystem;

namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Renders with by-depth.slang edited; what stood there before has to stay.
void fails(const Bench::Edits& edits, const std::vector<std::string>& said) {
  Desk desk;
  desk.write("two.obj", twoTriangles());
  desk.write("a.exr", "mine");
  const Bench bench;
  const fs::path kernel = bench.edited("by-depth.slang", edits);
  const auto outcome =
      desk.tessera("render two.obj --size 24x24 -o a.exr --set shade=id --kernel shade=" + kernel.string());
  INFO(outcome.err);
  CHECK(outcome.code == 2);
  CHECK(outcome.complainsOnce());
  CHECK(has(outcome.err, "kernel shade (" + kernel.string() + "): "));
  for (const std::string& part : said) CHECK(has(outcome.err, part));
  CHECK(desk.read("a.exr") == "mine");
}

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
