// Where outputs go, and what is refused before the first frame.
#include <sys/stat.h>
#include <sys/sysmacros.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <sstream>

#include "run-tessera.h"

using nlohmann::json;
using tessera::test::Desk;

namespace {

const std::string kRender = "render two.obj --size 16x16 ";

std::size_t lines(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace

TEST_CASE("Rows are added to a file and written to what is no file") {
  Desk desk;
  desk.write("two.obj", tessera::test::twoTriangles());
  desk.write("rows.jsonl", "{\"old\":1}\n");
  REQUIRE(desk.tessera(kRender + "--json rows.jsonl").code == 0);
  REQUIRE(desk.tessera(kRender + "--json rows.jsonl").code == 0);
  const std::string rows = desk.read("rows.jsonl");
  CHECK(rows.starts_with("{\"old\":1}\n"));
  CHECK(lines(rows) == 3);
  const auto out = desk.tessera(kRender + "--json /dev/stdout");
  CHECK(out.code == 0);
  CHECK(json::parse(out.out)["status"] == "ok");
  CHECK(out.err.find("pixels covered") != std::string::npos);
  REQUIRE(mkfifo((desk.path() / "pipe").c_str(), 0600) == 0);
  const auto piped = desk.tessera(kRender + "--json pipe", "(cat pipe >from-pipe 2>&1 &);");
  CHECK(piped.code == 0);
  CHECK(std::filesystem::is_fifo(desk.path() / "pipe"));
  const auto full = desk.tessera(kRender + "--json /dev/full");
  INFO(full.err);
  CHECK(full.code == 1);
  CHECK(full.err.find("/dev/full: could not be written: No space left on device") != std::string::npos);
  if (mknod((desk.path() / "null").c_str(), S_IFCHR | 0666, makedev(1, 3)) != 0) return;  // as root only
  CHECK(desk.tessera(kRender + "--json null").code == 0);
  CHECK(std::filesystem::is_character_file(desk.path() / "null"));
}

TEST_CASE("A row that does not fit leaves the rows before it and the reason") {
  Desk desk;
  desk.write("two.obj", tessera::test::twoTriangles());
  const std::string old = std::string(2000, 'x') + '\n';
  desk.write("rows.jsonl", old);
  const auto outcome = desk.tessera("render two.obj --size 16x16 --json rows.jsonl", "ulimit -f 2;");
  INFO(outcome.err);
  CHECK(outcome.code == 1);
  CHECK(outcome.err.find("rows.jsonl: could not be written: ") != std::string::npos);
  CHECK(desk.read("rows.jsonl") == old);
}

TEST_CASE("Two outputs of one file and outputs that are inputs are refused") {
  Desk desk;
  desk.write("two.obj", tessera::test::twoTriangles());
  desk.write("mine.comp", "void main() {}\n");
  desk.write("scene.toml", "size = [16, 16]\n[[mesh]]\nsource = \"two.obj\"\n");
  std::filesystem::create_symlink("two.obj", desk.path() / "two.png");
  std::filesystem::create_hard_link(desk.path() / "two.obj", desk.path() / "hard.png");
  checkRefused(desk, kRender + "-o two.png", "is the input two.obj");
  checkRefused(desk, kRender + "-o hard.png", "is the input two.obj");
  checkRefused(desk, "render scene.toml --json two.obj", "is an input");
  checkRefused(desk, "render scene.toml --json scene.toml", "is an input");
  checkRefused(desk, kRender + "--device vulkan --kernel transform=mine.comp --json mine.comp", "is an input");
  checkRefused(desk, "parity scene.toml --device cpu --replay two.obj", "two.obj");
  checkRefused(desk, "parity two.obj --device cpu --replay a --json ./a", "is the same file as");
  checkRefused(desk, kRender + "-o a.png -o a.png", "is named twice");
  checkRefused(desk, kRender + "-o a.png -o ./a.png", "is the same file as");
  checkRefused(desk, kRender + "-o png:- --json -", "is named twice");
  CHECK(desk.read("two.obj") == tessera::test::twoTriangles());
}

TEST_CASE("What killed runs left is cleared and a reader that goes is an error") {
  Desk desk;
  desk.write("two.obj", tessera::test::twoTriangles());
  desk.write("a.png.999-abcdefgh.tmp", "half");
  std::filesystem::create_directory(desk.path() / "a.png.part");
  CHECK(desk.tessera(kRender + "-o a.png").code == 0);
  CHECK(desk.names() == std::vector<std::string>{"a.png", "a.png.part", "two.obj"});
  // Opened for writing once there is a reader, and left by it.
  desk.tessera("variants >&5 2>said; echo $? >code #", "mkfifo pipe; (exec 4<pipe) & exec 5>pipe; wait;");
  CHECK(desk.read("code") == "1\n");
  CHECK(desk.read("said") == "tessera: stdout: could not be written: Broken pipe\n");
}

TEST_CASE("What stdout cannot take is an error with its cause whatever was asked") {
  Desk desk;
  desk.write("two.obj", tessera::test::twoTriangles());
  desk.write("tile.toml",
             "title = \"T\"\nquestion = \"Q?\"\nsizes = [16]\n[scenes]\nball = \"generate:icosphere?level=1\"\n"
             "[axes]\ntile = [8, 16]\n");
  for (const char* const arguments :
       {"--version", "--help", "version", "help render", "render --help", "variants", "meshes", "man",
        "completion bash", "plan two.obj", "expand tile.toml --no-estimate", "render two.obj --size 16"}) {
    desk.tessera(std::string(arguments) + " >/dev/full 2>said; echo $? >code #");
    INFO("tessera " << arguments);
    CHECK(desk.read("code") == "1\n");
    CHECK(desk.read("said") == "tessera: stdout: could not be written: No space left on device\n");
  }
}

TEST_CASE("A C++ compiler that is none is named with what it did") {
  Desk desk;
  desk.write("two.obj", tessera::test::twoTriangles());
  desk.write("talks", "#!/bin/sh\necho 'no such option' >&2\nexit 3\n");
  std::filesystem::permissions(desk.path() / "talks", std::filesystem::perms(0755));
  for (const auto& [compiler, why] : std::initializer_list<std::pair<const char*, const char*>>{
           {"false", "/false -march=native -dM -E -x c++ /dev/null' ended with exit status 1 and printed nothing"},
           {"true", "/true -march=native -dM -E -x c++ /dev/null' names no macro __cplusplus"},
           {"./talks", "ended with exit status 3 and printed: no such option"}}) {
    const auto outcome = desk.tessera(kRender + "-o a.png", std::string("TESSERA_CXX=") + compiler);
    INFO(outcome.err);
    CHECK(outcome.code == 2);
    CHECK(outcome.complainsOnce());
    CHECK(outcome.err.find(std::string("TESSERA_CXX=") + compiler + ": ") != std::string::npos);
    CHECK(outcome.err.find(why) != std::string::npos);
  }
}

TEST_CASE("Folders that are full or missing or of others are named") {
  Desk desk;
  desk.write("two.obj", tessera::test::twoTriangles());
  const auto missing = desk.tessera(kRender + "-o a.png", "TESSERA_CACHE=$PWD/cold TMPDIR=/nowhere/tmp");
  INFO(missing.err);
  CHECK(missing.code == 2);
  CHECK(missing.complainsOnce());
  CHECK(missing.err.find("/nowhere/tmp: cannot be written: No such file or directory") != std::string::npos);
  const auto full = desk.tessera(kRender + "-o a.png", "ulimit -f 1; TESSERA_CACHE=$PWD/cold");
  INFO(full.err);
  CHECK(full.code == 1);
  CHECK(full.err.find("cannot be written: File too large") != std::string::npos);
  CHECK(full.err.find("./dev build") == std::string::npos);
  std::filesystem::create_directory(desk.path() / "open");
  std::filesystem::permissions(desk.path() / "open", std::filesystem::perms(0777));
  const auto open = desk.tessera(kRender + "-o a.png", "TESSERA_CACHE=open");
  INFO(open.err);
  CHECK(open.code == 2);
  CHECK(open.complainsOnce());
  CHECK(open.err.find("open: others can write it (mode 777)") != std::string::npos);
}

TEST_CASE("A thread that cannot be made is an error and no abort") {
  Desk desk;
  desk.write("two.obj", tessera::test::twoTriangles());
  const std::string none = "LD_PRELOAD=" TESSERA_NO_THREADS;
  const auto several = desk.tessera(kRender + "--threads 4 --json row.json", none);
  INFO(several.err);
  CHECK(several.code == 1);
  CHECK(several.err ==
        "tessera: cpu: thread 2 of 4 cannot be made: Resource temporarily unavailable; --threads 1 would do\n");
  const auto one = desk.tessera(kRender + "--threads 1 --json row.json", none);
  INFO(one.err);
  CHECK(one.code == 0);
  CHECK(desk.names() == std::vector<std::string>{"row.json", "two.obj"});
  // OpenImageIO's libraries would end the process.
  const auto picture = desk.tessera(kRender + "--threads 1 -o a.png", none);
  INFO(picture.err);
  CHECK(picture.code == 1);
  CHECK(picture.err.find("thread 1 cannot be made: Resource temporarily unavailable\n") != std::string::npos);
  CHECK(desk.names() == std::vector<std::string>{"row.json", "two.obj"});
}

TEST_CASE("A process that cannot be made is no fault of the compiler") {
  Desk desk;
  desk.write("two.obj", tessera::test::twoTriangles());
  const auto full =
      desk.tessera(kRender + "--threads 1", "NO_PROCESSES=1 TESSERA_CACHE=cache LD_PRELOAD=" TESSERA_NO_THREADS);
  INFO(full.err);
  CHECK(full.code == 1);
  CHECK(full.complainsOnce());
  CHECK(full.err.find("slangc: cannot be run: Resource temporarily unavailable\n") != std::string::npos);
}

TEST_CASE("A picture without a pixel is named, where another line says something else, too") {
  Desk desk;
  desk.write("thin.obj", "v 0 0 0\nv 1 0 0\nv 0 1e-7 0\nf 1 2 3\nf 1 2 9\n");
  desk.write("thin.toml", "[[mesh]]\nsource = \"thin.obj\"\n[camera]\neye = [0,0,5]\ntarget = [0,0,0]\n");
  const auto thin = desk.tessera("render thin.toml --size 16 -q");
  INFO(thin.err);
  CHECK(thin.code == 0);
  CHECK(thin.err.find("1 of 2 triangles has an index out of range and is not drawn") != std::string::npos);
  CHECK(thin.err.find("no pixel is covered: ") != std::string::npos);
}
