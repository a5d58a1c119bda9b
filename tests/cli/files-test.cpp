// Input that is missing or broken and output that cannot be written: one line, exit code 2, and no file, whole or half.
#include <unistd.h>

#include <catch2/catch.hpp>

#include "run-tessera.h"

using tessera::test::Desk;

TEST_CASE("Input that is missing or broken is refused") {
  Desk desk;
  desk.write("empty.obj", "");
  desk.write("empty.off", "");
  desk.write("cut.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n");
  desk.write("cut.ply", "ply\nformat binary_little_endian 1.0\nelement vertex 3\n");
  desk.write("noise.stl", std::string("\x01\x02\x03", 3));
  desk.write("broken.toml", "size = [16\n");
  desk.write("typo.toml", "siez = [16, 16]\n");
  desk.write("noise.replay", "nonsense\n");
  desk.write("mesh.xyz", "0 0 0\n");
  desk.write("mesh", "0 0 0\n");
  for (const char* const input :
       {"missing.obj", "missing.toml", "missing.replay", "empty.obj", "empty.off", "cut.off", "cut.ply", "noise.stl",
        "broken.toml", "typo.toml", "noise.replay", "mesh.xyz", "mesh", ".", "generate:", "generate:teapot",
        "generate:icosphere?level=99", "generate:icosphere?level=", "generate:icosphere?levle=1"}) {
    const std::string quoted = std::string("'") + input + "'";
    const std::string named = std::string(input).starts_with("generate:") ? "generate" : input;
    checkRefused(desk, "render " + quoted + " -o a.png --json row.json", named);
    checkRefused(desk, "plan " + quoted, named);
    checkRefused(desk, "parity --device cpu " + quoted, named);
  }
}

TEST_CASE("Output that cannot be written is refused before any work") {
  Desk desk;
  desk.write("two.obj", tessera::test::twoTriangles());
  std::filesystem::create_directory(desk.path() / "folder.png");
  std::filesystem::create_directory(desk.path() / "folder");
  // The input is missing too: had work begun, the line would name that.
  for (const char* const output :
       {"-o a.jpg", "-o a", "-o ''", "-o no-folder/a.png", "-o folder.png", "-o two.obj/a.png",
        "--json no-folder/row.json", "--json folder", "-o a.png --json no-folder/row.json"}) {
    const std::string arguments = std::string("render missing.obj ") + output;
    const auto outcome = desk.tessera(arguments);
    INFO("tessera " << arguments << "\n" << outcome.err);
    CHECK(outcome.code == 2);
    CHECK(outcome.complainsOnce());
    CHECK(outcome.err.find("missing.obj") == std::string::npos);
  }
  checkRefused(desk, "parity missing.obj --device cpu --replay no-folder/x.replay", "no-folder");
  checkRefused(desk, "render two.obj --json two.obj", "two.obj");
  CHECK(desk.names() == std::vector<std::string>{"folder", "folder.png", "two.obj"});
  CHECK(desk.read("two.obj") == tessera::test::twoTriangles());
}

TEST_CASE("A folder without permission is refused") {
  if (geteuid() == 0) {
    Desk desk;  // root may write everywhere: /proc stands for a folder that refuses
    desk.write("two.obj", tessera::test::twoTriangles());
    const auto outcome = desk.tessera("render two.obj --json /proc/row.json --size 16x16");
    INFO(outcome.err);
    CHECK(outcome.code != 0);
    CHECK(outcome.complainsOnce());
    return;
  }
  Desk desk;
  desk.write("two.obj", tessera::test::twoTriangles());
  std::filesystem::create_directory(desk.path() / "locked");
  std::filesystem::permissions(desk.path() / "locked",
                               std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  checkRefused(desk, "render two.obj -o locked/a.png", "locked");
  checkRefused(desk, "render two.obj --json locked/row.json", "locked");
}

TEST_CASE("Compare refuses what is no image of ours") {
  Desk desk;
  desk.write("noise.exr", "nonsense");
  desk.write("empty.exr", "");
  checkRefused(desk, "compare missing.exr noise.exr", "missing.exr");
  checkRefused(desk, "compare noise.exr noise.exr", "noise.exr");
  checkRefused(desk, "compare empty.exr empty.exr", "empty.exr");
  checkRefused(desk, "compare missing.exr noise.exr -o a.jpg", "a.jpg");
}

TEST_CASE("Standard output that is full is an error") {
  Desk desk;
  CHECK(desk.tessera("variants >/dev/null #").code == 0);
  CHECK(desk.tessera("variants >/dev/full 2>/dev/null #").code == 1);
}

TEST_CASE("A cache and a compiler that cannot be used are one line") {
  Desk desk;
  desk.write("two.obj", tessera::test::twoTriangles());
  desk.write("file", "");
  const auto cache = desk.tessera("render two.obj -o a.png --size 16x16", "TESSERA_CACHE=file/below");
  INFO(cache.err);
  CHECK(cache.code != 0);
  CHECK(cache.complainsOnce());
  const auto compiler = desk.tessera("render two.obj -o a.png --size 16x16", "SLANGC=/no/such/slangc");
  INFO(compiler.err);
  CHECK(compiler.code == 2);
  CHECK(compiler.complainsOnce());
  CHECK(compiler.err.find("/no/such/slangc") != std::string::npos);
  CHECK(desk.names() == std::vector<std::string>{"file", "two.obj"});
}
