// What a command says when it is asked: which meshes there are, what a plan runs, which devices there are; and what of
// a sweep the command line may change.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "run-tessera.h"

using nlohmann::json;
using tessera::test::Desk;

namespace {

bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("Installed meshes are listed and a mistyped one is answered by the nearest") {
  Desk desk;
  const auto all = desk.tessera("render mesh:");
  CHECK(all.code == 2);
  CHECK(all.complainsOnce());
  for (const char* const name : {"refined_elephant", "cube", "bunny00"}) CHECK(says(all.err, name));
  const auto close = desk.tessera("render mesh:refined_elefant");
  CHECK(close.code == 2);
  CHECK(close.complainsOnce());
  CHECK(says(close.err, "did you mean mesh:refined_elephant?"));
  const auto far = desk.tessera("render mesh:zzzzzzzz");
  CHECK(says(far.err, "'tessera meshes' lists the "));
  const auto listed = desk.tessera("meshes");
  CHECK(listed.code == 0);
  CHECK(listed.err.empty());
  for (const char* const line : {"mesh:refined_elephant\n", "mesh:cube\n", "generate:icosphere\n"})
    CHECK(says(listed.out, line));
}

TEST_CASE("A plan takes an attribute and kernels and threads") {
  Desk desk;
  desk.write("two.obj", tessera::test::twoTriangles());
  desk.write("mine.slang", "[shader(\"compute\")] [numthreads(1, 1, 1)] void shade() {}\n");
  const json plain = json::parse(desk.tessera("plan two.obj --json").out);
  const json asked = json::parse(
      desk.tessera("plan two.obj --json --attribute x --threads 1 --set shade=flat --kernel shade=mine.slang").out);
  const auto kept = [](const json& plan, const std::string& pass) {
    for (const json& entry : plan["plan"])
      if (entry["pass"] == pass) return entry["kept"].get<bool>();
    return false;
  };
  CHECK_FALSE(kept(plain, "attribute"));
  CHECK(kept(asked, "attribute"));
  CHECK(asked["kernels"]["shade"] == "mine.slang");
  CHECK(
      says(desk.tessera("plan two.obj --set shade=flat --kernel shade=mine.slang").out, "kernel of shade: mine.slang"));
  const auto refused = desk.tessera("plan two.obj --kernel shade=mine.slang");
  CHECK(refused.code == 2);
  CHECK(says(refused.err, "this plan does not run such a stage"));
  CHECK(desk.tessera("plan two.obj --attribute quality").code == 2);
}

TEST_CASE("Devices are listed as JSON") {
  Desk desk;
  const auto outcome = desk.tessera("devices --json -q");
  CHECK(outcome.code == 0);
  CHECK(outcome.err.empty());
  const json all = json::parse(outcome.out);
  REQUIRE(all["devices"].size() >= 2);
  CHECK(all["devices"][0]["device"] == "cpu");
  CHECK(all["devices"][0]["probe"]["cpp"] == "passed");
  CHECK(all["devices"][0]["loop"].is_null());  // no limit
  CHECK(all["devices"][1]["device"] == "vulkan:0");
  CHECK(all["devices"][1]["software"].is_boolean());
  CHECK(all["slangc"]["version"].is_string());
}

TEST_CASE("Rounds and devices of a sweep are the command line's and a resume goes on with them") {
  Desk desk;
  desk.write("tile.toml",
             "title = \"T\"\nquestion = \"Q?\"\nsizes = [16]\nrounds = 4\ndevices = [\"vulkan\"]\n"
             "[scenes]\nball = \"generate:icosphere?level=1\"\n[axes]\ntile = [8, 16]\n");
  const auto expanded = desk.tessera("expand tile.toml --rounds 2 --devices cpu --no-estimate");
  INFO(expanded.err);
  CHECK(says(expanded.out, "ball@cpu"));
  CHECK_FALSE(says(expanded.out, "ball@vulkan"));
  CHECK(says(expanded.out, "2 rounds"));
  CHECK(desk.tessera("sweep tile.toml --out new --rounds 2 --devices cpu -q").out.empty());
  const std::string rows = desk.read("new/rows.jsonl");
  const json row = json::parse(rows.substr(0, rows.find('\n')));
  CHECK(row.at("time_ns").at("samples").size() == 2);
  CHECK(row.at("sweep").at("device") == "cpu");
  for (const auto& [arguments, code, said] : std::initializer_list<std::tuple<const char*, int, const char*>>{
           {"--resume", 0, "nothing was left to do"},
           {"--resume --rounds 2 --devices cpu", 0, "nothing was left to do"},
           {"--resume --rounds 3", 2, "--rounds 3: the sweep in new was begun with 2"},
           {"--resume --devices vulkan", 2, "--devices vulkan: the sweep in new was begun with cpu"},
           {"--resume --devices toaster", 2, "begun with cpu"}}) {
    const auto outcome = desk.tessera(std::string("sweep tile.toml --out new ") + arguments);
    INFO(arguments << outcome.out << outcome.err);
    CHECK(outcome.code == code);
    CHECK(says(outcome.out + outcome.err, said));
  }
  CHECK(desk.read("new/rows.jsonl") == rows);
  CHECK(says(desk.tessera("expand tile.toml --devices toaster").err, "no such device"));
  CHECK(desk.tessera("expand tile.toml --devices cpu,cpu").code == 2);
  CHECK(says(desk.tessera("sweep tile.toml --out x --rounds 0").err, "1 to 1000"));
}
