// Input that is missing or broken and output that cannot be written: one line, exit code 2, and no file, whole or half.
#include <fmt/format.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <future>
#include <mutex>
#include <tuple>

#include "run-tessera.h"

using tessera::test::Desk;
using tessera::test::Outcome;

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
  CHECK(cache.code == 2);
  CHECK(cache.complainsOnce());
  const auto compiler = desk.tessera("render two.obj -o a.png --size 16x16", "SLANGC=/no/such/slangc");
  INFO(compiler.err);
  CHECK(compiler.code == 2);
  CHECK(compiler.complainsOnce());
  CHECK(compiler.err.find("/no/such/slangc") != std::string::npos);
  CHECK(desk.names() == std::vector<std::string>{"file", "two.obj"});
}

TEST_CASE("What is no file is named as what it is where a kernel is asked for") {
  Desk desk;
  desk.write("two.obj", tessera::test::twoTriangles());
  std::filesystem::create_directory(desk.path() / "folder.slang");
  std::filesystem::create_symlink("/dev/zero", desk.path() / "zero.slang");
  REQUIRE(mkfifo((desk.path() / "pipe.slang").c_str(), 0600) == 0);
  const std::string sweep = "title = \"T\"\nquestion = \"Q\"\nsizes = [16]\n";
  for (const auto& [file, what] : {std::pair{"none.slang", "no such file"},
                                   {"folder.slang", "is a folder; a file would be right"},
                                   {".", "is a folder; a file would be right"},
                                   {"/dev/null", "is a device; a file would be right"},
                                   {"zero.slang", "is a device; a file would be right"},
                                   {"pipe.slang", "is a pipe; a file would be right"}}) {
    checkRefused(desk, fmt::format("render two.obj --kernel transform={}", file), fmt::format("{}: {}", file, what));
    desk.write("a.toml",
               sweep + fmt::format("[scenes]\ntwo = \"two.obj\"\n[kernels]\ntransform = [\"\", \"{}\"]\n", file));
    checkRefused(desk, "expand a.toml", fmt::format("{}: {}", std::string(file) == "." ? "" : file, what));
  }
  std::filesystem::rename(desk.path() / "pipe.slang", desk.path() / "pipe.obj");
  desk.write("a.toml", sweep + "[scenes]\ntwo = \"pipe.obj\"\n");
  checkRefused(desk, "expand a.toml", "pipe.obj: is a pipe; a file would be right");
  std::filesystem::rename(desk.path() / "pipe.obj", desk.path() / "pipe.exr");
  checkRefused(desk, "compare pipe.exr pipe.exr", "pipe.exr: is a pipe; a file would be right");
}

TEST_CASE("Files and folders that may not be read or written are bad input") {
  Desk desk;
  desk.write("two.obj", tessera::test::twoTriangles());
  desk.write("secret.obj", tessera::test::twoTriangles());
  desk.write("secret.slang", "[numthreads(1, 1, 1)] void transform() {}");
  desk.write("user.slang", "import secret;\n[numthreads(1, 1, 1)] void transform() {}");
  for (const char* const name : {"secret.obj", "secret.slang"})
    std::filesystem::permissions(desk.path() / name, std::filesystem::perms::none);
  std::filesystem::create_directory(desk.path() / "locked");
  std::filesystem::permissions(desk.path() / "locked", std::filesystem::perms(0555));
  std::filesystem::permissions(desk.path(), std::filesystem::perms(0755));
  // Root may read and write all of it.
  const std::string asNobody = geteuid() == 0 ? "setpriv --reuid=65534 --regid=65534 --clear-groups" : "";
  desk.tessera("render two.obj -q");  // compiles the stages' own kernels, which all may read
  for (const auto& [arguments, cache, named] :
       {std::tuple{"render secret.obj", "", "secret.obj: Permission denied"},
        {"render two.obj --kernel transform=secret.slang", "", "secret.slang: cannot be read: Permission denied"},
        {"render two.obj --kernel transform=user.slang", "", "secret.slang: cannot be read: Permission denied"},
        {"render two.obj", "TESSERA_CACHE=locked/cache ", "locked/cache"}}) {
    const auto outcome = desk.tessera(arguments, cache + asNobody);
    INFO(arguments << "\n" << outcome.err);
    CHECK(outcome.code == 2);
    CHECK(outcome.complainsOnce());
    CHECK(outcome.err.find(named) != std::string::npos);
  }
  std::filesystem::permissions(desk.path() / "locked", std::filesystem::perms(0755));
}

TEST_CASE("An input that is a pipe has ten seconds to find its writer") {
  Desk desk;
  desk.write("two.obj", tessera::test::twoTriangles());
  for (const char* const name : {"p.obj", "p.toml"}) REQUIRE(mkfifo((desk.path() / name).c_str(), 0600) == 0);
  std::vector<std::future<void>> waiting;  // at the same time: each takes ten seconds
  std::mutex mutex;
  std::vector<std::pair<std::string, Outcome>> outcomes;
  for (const std::string arguments : {"render p.obj -q", "render p.toml -q", "expand p.toml -q"})
    waiting.push_back(std::async(std::launch::async, [&, arguments] {
      const std::filesystem::path err = desk.path() / (arguments.substr(0, 6) + arguments.substr(7) + ".err");
      const int status = std::system(fmt::format("cd '{}' && timeout 60 '{}' {} </dev/null 2>'{}'",
                                                 desk.path().string(), TESSERA_PROGRAM, arguments, err.string())
                                         .c_str());
      const std::lock_guard lock(mutex);
      outcomes.emplace_back(arguments,
                            Outcome{.code = WEXITSTATUS(status), .out = "", .err = desk.read(err.filename())});
    }));
  waiting.clear();
  for (const auto& [arguments, outcome] : outcomes) {
    INFO(arguments << "\n" << outcome.err);
    CHECK(outcome.code == 2);
    CHECK(outcome.complainsOnce());
    CHECK(outcome.err.find(": is a pipe that nothing has opened to write to for 10 s; start its writer first") !=
          std::string::npos);
  }
  // A writer that is there takes its time.
  const auto slow = desk.tessera("render p.obj --size 16 -q --json a.jsonl",
                                 "{ timeout 40 sh -c '{ sleep 12; cat two.obj; } >p.obj' & }; timeout 60");
  INFO(slow.err);
  CHECK(slow.code == 0);
  const auto late = desk.tessera("render p.obj --size 16 -q --json a.jsonl",
                                 "{ timeout 40 sh -c 'sleep 1; cat two.obj >p.obj' & }; timeout 60");
  INFO(late.err);
  CHECK(late.code == 0);
}

TEST_CASE("Where no more files can be opened that is what an image's error says") {
  Desk desk;
  desk.write("two.obj", tessera::test::twoTriangles());
  desk.tessera("render two.obj --size 16 -o warm.png -o warm.exr");
  for (const std::string name : {"a.png", "a.exr"}) {
    const auto render = [&](const std::string& before) {
      return desk.tessera("render two.obj --size 16 -q -o " + name, before);
    };
    // What opens the image's file, and what reads the file again, meet the limit one after the other.
    int streams = 0;
    for (; streams < 20; ++streams) {
      const auto outcome = render(fmt::format("FULL_AT={} LD_PRELOAD={}", streams + 1, TESSERA_NO_FILES));
      INFO(name << ", stream " << streams + 1 << ": " << outcome.err);
      if (outcome.code == 0) break;
      CHECK(outcome.code == 1);
      CHECK(outcome.err == fmt::format("tessera: {}: could not be written: Too many open files\n", name));
      CHECK_FALSE(std::filesystem::exists(desk.path() / name));
    }
    INFO(name);
    CHECK(streams >= 2);
    CHECK(std::filesystem::exists(desk.path() / name));
    // Which part of the program is the first to meet a limit from outside depends on who starts the program, and on
    // which thread comes first: OpenImageIO is loaded beside the first frame.
    bool written = false;
    for (int files = 4; files < 64 && !written; ++files) {
      const auto outcome = render(fmt::format("prlimit --nofile={}", files));
      INFO(name << ", " << files << " files: " << outcome.err);
      // The program has not begun: how many files are open by then depends on who starts it.
      if (outcome.err.find("error while loading shared libraries") != std::string::npos) continue;
      written = outcome.code == 0;
      CHECK((written || outcome.err.find("Too many open files") != std::string::npos));
    }
    CHECK(written);
  }
}
