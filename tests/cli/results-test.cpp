// What the commands do when all is well, and their verdicts.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "run-tessera.h"

using nlohmann::json;
using tessera::test::Desk;

namespace {

using Names = std::vector<std::string>;

/// A triangle over half the raster, in clip space by an identity camera; `depth` may be moved.
std::string flatScene() {
  return "size = [64, 48]\n[[mesh]]\nsource = \"two.obj\"\n[camera]\nmatrix = [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]\n";
}

}  // namespace

TEST_CASE("Render writes images and a row and says what it did") {
  Desk desk;
  desk.write("two.obj", tessera::test::twoTriangles());
  desk.write("flat.toml", flatScene());
  const auto outcome = desk.tessera("render flat.toml -o a.png -o a.exr --repeat 3 --json row.json --set tile=8");
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  CHECK(desk.names() == Names{"a.exr", "a.png", "flat.toml", "row.json", "two.obj"});
  CHECK(outcome.out.find("2 triangles, 64 x 48") != std::string::npos);

  const std::string line = desk.read("row.json");
  CHECK(std::count(line.begin(), line.end(), '\n') == 1);
  const json row = json::parse(line);
  CHECK(row["schema_version"] == 3);
  CHECK(row["status"] == "ok");
  CHECK(row["variant"]["tile"] == "8");
  CHECK(row["scene"]["triangles"] == 2);
  CHECK(row["scene"]["size"] == json{64, 48});
  CHECK(row["scene"]["sha256"].get<std::string>().size() == 64);
  CHECK(row["time_ns"]["samples"].size() == 3);
  CHECK(row["time_ns"]["min"] <= row["time_ns"]["median"]);
  CHECK(row["time_ns"]["stages"].size() > 2);
  CHECK(row["counters"]["submitted"] == 2);
  CHECK(row["counters"]["tests"] > 0);
  CHECK(row["counters"]["covered"] > 0);
  CHECK(row["plan"].size() > 2);
  CHECK(row["provenance"]["api"] == "cpu");
  CHECK_FALSE(row["provenance"]["slang"].get<std::string>().empty());
}

TEST_CASE("A row on stdout is alone there") {
  Desk desk;
  const auto outcome = desk.tessera("render 'generate:icosphere?level=1' --size 32x32 --json -");
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  CHECK(json::parse(outcome.out)["scene"]["triangles"] == 80);
  CHECK(outcome.err.find("80 triangles") != std::string::npos);
  CHECK(desk.names().empty());
}

TEST_CASE("Run ids sort by time and differ") {
  Desk desk;
  std::string last;
  for (int i = 0; i < 3; ++i) {
    const auto outcome = desk.tessera("render 'generate:icosphere?level=0' --size 8x8 --json -");
    REQUIRE(outcome.code == 0);
    const std::string id = json::parse(outcome.out)["run_id"];
    CHECK(id > last);
    last = id;
  }
}

TEST_CASE("Overflow and a variant that cannot run leave a row and their exit codes") {
  Desk desk;
  const auto outcome = desk.tessera(
      "render 'generate:hot?count=5000' --size 64x64 --json row.json -o a.png --set binning=queue --set capacity=16 "
      "--set overflow=error");
  INFO(outcome.err);
  CHECK(outcome.code == 3);
  CHECK(outcome.complainsOnce());
  CHECK(desk.names() == Names{"row.json"});
  CHECK(json::parse(desk.read("row.json"))["status"] == "overflow");
}

TEST_CASE("Compare finds one pixel and draws it") {
  Desk desk;
  desk.write("two.obj", tessera::test::twoTriangles());
  desk.write("flat.toml", flatScene());
  std::string moved = tessera::test::twoTriangles();
  moved.replace(moved.find("v 0 1 0"), 7, "v 0 .9 0");
  desk.write("moved.obj", moved);
  std::string scene = flatScene();
  scene.replace(scene.find("two.obj"), 7, "moved.obj");
  desk.write("moved.toml", scene);
  REQUIRE(desk.tessera("render flat.toml -o a.exr").code == 0);
  REQUIRE(desk.tessera("render moved.toml -o b.exr").code == 0);
  const auto same = desk.tessera("compare a.exr a.exr -o same.png");
  CHECK(same.code == 0);
  CHECK(same.out.find("equal") != std::string::npos);
  const auto other = desk.tessera("compare a.exr b.exr -o other.png");
  INFO(other.out << other.err);
  CHECK(other.code == 5);
  CHECK(other.out.find("first difference at pixel") != std::string::npos);
  CHECK(std::filesystem::exists(desk.path() / "other.png"));

  REQUIRE(desk.tessera("render flat.toml -o small.exr --size 8x8").code == 0);
  REQUIRE(desk.tessera("render 'generate:icosphere?level=0' --size 8x8 -o plain.exr").code == 0);
  REQUIRE(desk.tessera("render 'generate:icosphere?level=0' --size 8x8 --set shade=id -o shaded.exr").code == 0);
  const auto partly = desk.tessera("compare plain.exr shaded.exr");
  CHECK(partly.code == 0);
  CHECK(partly.out.find("colour: only in shaded.exr, not compared") != std::string::npos);

  const auto sizes = desk.tessera("compare a.exr small.exr");
  CHECK(sizes.code == 2);
  CHECK(sizes.complainsOnce());
  // A picture over one of its own inputs would lose it.
  const auto over = desk.tessera("compare a.exr b.exr -o b.exr");
  CHECK(over.code == 2);
  CHECK(over.complainsOnce());
}

TEST_CASE("Parity says equal and leaves nothing behind") {
  Desk desk;
  for (const char* const more : {"", " --set commit=count", " --set shade=smooth"}) {
    const auto outcome =
        desk.tessera(std::string("parity 'generate:icosphere?level=2' --size 100x75 --json rows.jsonl") + more);
    INFO(more << outcome.out << outcome.err);
    CHECK(outcome.code == 0);
    CHECK(outcome.out.find("parity: equal") != std::string::npos);
    CHECK(desk.names() == Names{"rows.jsonl"});
    std::istringstream rows(desk.read("rows.jsonl"));
    for (std::string line; std::getline(rows, line);) {
      const json error = json::parse(line)["error"];
      CHECK(error["pixels"] == 7500);
      const bool counts = std::string(more).ends_with("count");
      CHECK(error[counts ? "hit_count_mismatch" : "id_mismatch"] == 0);
      CHECK(error[counts ? "id_mismatch" : "hit_count_mismatch"].is_null());
      CHECK(error["attribute_mismatch"].is_null());
    }
    std::filesystem::remove(desk.path() / "rows.jsonl");  // the next rows are added to those that are there
  }
}

TEST_CASE("Parity names the first stage that differs") {
  Desk desk;
  // A transform that is right on the CPU alone. The program takes its kernels from this folder.
  std::filesystem::copy(TESSERA_SOURCE_DIR "/slang", desk.path() / "slang", std::filesystem::copy_options::recursive);
  std::string transform = desk.read("slang/stages/transform.slang");
  const std::string store = "clipSpace[v] = c;";
  REQUIRE(transform.find(store) != std::string::npos);
  transform.insert(transform.find(store), "\n#ifndef TESSERA_CPP\n c.x = c.x + 0.25f;\n#endif\n");
  desk.write("slang/stages/transform.slang", transform);

  const auto outcome = desk.tessera("parity 'generate:icosphere?level=0' --size 64x64 --replay found.replay",
                                    "TESSERA_SLANG_SOURCES=slang");
  INFO(outcome.out << outcome.err);
  CHECK(outcome.code == 5);
  CHECK(outcome.out.find("parity: DIFFERENT; 1 of ") != std::string::npos);
  CHECK(outcome.out.find("first difference at pixel (") != std::string::npos);
  CHECK(outcome.out.find("first stage that differs: transform, vertex 0 (clip x y z w), word 0: 0x") !=
        std::string::npos);
  // A replay begins after the transform, and so would not show it.
  CHECK(outcome.err.find("no replay: ") != std::string::npos);
  CHECK(desk.names() == Names{"slang"});
}

TEST_CASE("Plan and variants and devices print what they promise") {
  Desk desk;
  const auto plan = desk.tessera("plan 'generate:icosphere?level=2' --json");
  REQUIRE(plan.code == 0);
  const json entries = json::parse(plan.out)["plan"];
  REQUIRE(entries.size() > 2);
  for (const auto& entry : entries) CHECK_FALSE(entry["why"].get<std::string>().empty());
  const json axes = json::parse(desk.tessera("variants --json").out);
  const std::string text = desk.tessera("variants").out, markdown = desk.tessera("variants --markdown").out;
  for (const auto& axis : axes) {
    CHECK(text.find(axis["name"].get<std::string>() + ": ") != std::string::npos);
    CHECK(markdown.find("## " + axis["name"].get<std::string>() + "\n") != std::string::npos);
    for (const auto& value : axis.value("values", json::array()))
      for (const char* const field : {"name", "kind", "meaning", "limits", "source", "devices"}) CHECK(value.contains(field));
  }
  const auto devices = desk.tessera("devices");
  INFO(devices.out << devices.err);
  CHECK(devices.code == 0);
  for (const char* const word : {"cpu", "int64", "probe", "slangc", "passed"})
    CHECK(devices.out.find(word) != std::string::npos);
}
