// What render says of an image's error: of approximate variants always, of others when asked, of values and hits.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <sstream>

#include "run-tessera.h"

using nlohmann::json;
using tessera::test::Desk;

namespace {

constexpr const char* kSoup = "render 'generate:soup?count=3000&pixels=9000' --size 200x150 -o a.exr --json row.json";

json rowOf(Desk& desk, const std::string& arguments, std::string* summary = nullptr) {
  const auto outcome = desk.tessera(arguments);
  INFO(arguments << "\n" << outcome.out << outcome.err);
  REQUIRE(outcome.code == 0);
  if (summary) *summary = outcome.out;
  std::istringstream rows(desk.read("row.json"));  // the newest is the last
  std::string row;
  for (std::string line; std::getline(rows, line);) row = line;
  return json::parse(row);
}

}  // namespace

TEST_CASE("An approximate variant's error is in the row and the summary and an exact one's only on demand") {
  Desk desk;
  std::string summary;
  CHECK_FALSE(rowOf(desk, kSoup, &summary).contains("error"));
  CHECK(summary.find("oracle") == std::string::npos);
  const std::string drop =
      std::string(kSoup) + " --set binning=queue --set capacity=16 --set overflow=drop --set tile=64";
  const json lossy = rowOf(desk, drop + " --set shade=flat", &summary)["error"];
  CHECK(lossy["id_mismatch"] > 100);
  CHECK(lossy["depth_max_abs"] > 0);
  CHECK(lossy["psnr"] > 0);  // finite: the colours of what was lost are missing
  CHECK(summary.find("error against the oracle") != std::string::npos);
  CHECK(summary.find(" dB from exact ones") != std::string::npos);
  CHECK_FALSE(rowOf(desk, drop, &summary)["error"]["psnr"].is_number());  // no colours
  const json asked = rowOf(desk, std::string(kSoup) + " --error --set shade=flat", &summary)["error"];
  for (const char* const part : {"coverage_mismatch", "id_mismatch", "depth_mismatch"}) CHECK(asked[part] == 0);
  CHECK(summary.find("coverage 0, ids 0, depth 0") != std::string::npos);
  CHECK(summary.find("dB") == std::string::npos);  // nothing exact to hold its colours against but themselves
  CHECK(asked["colour_mismatch"].is_null());
}

TEST_CASE("A commit without ids has its coverage and depth held against the oracle") {
  Desk desk;
  const std::string render = "render 'generate:icosphere?level=2' --size 100x75 -o a.png --json row.json --set commit=";
  std::string summary;
  const json grey = rowOf(desk, render + "depth24+lum8")["error"],
             colours = rowOf(desk, render + "depth32+rgba8", &summary)["error"];
  for (const json& error : {grey, colours}) {
    CHECK(error["coverage_mismatch"] == 0);
    for (const char* const part : {"id_mismatch", "hit_count_mismatch"}) CHECK(error[part].is_null());
  }
  CHECK(summary.find("coverage 0, ids -, depth 0") != std::string::npos);
  CHECK(grey["depth_max_abs"] > 0);
  CHECK(grey["depth_max_abs"] < 0x1p-23);
  CHECK(colours["depth_max_abs"] == 0);
  CHECK(colours["psnr"] > 50);            // bytes for floats: half of 1/255 at most
  CHECK(grey["psnr"] < colours["psnr"]);  // and no hue
  CHECK(colours["colour_mismatch"] > 0);
}

TEST_CASE("An approximate variant is the same on every device though not the oracle's") {
  Desk desk;
  const auto outcome =
      desk.tessera("parity 'generate:icosphere?level=2' --size 100x75 --set commit=depth24+lum8 --json row.json");
  INFO(outcome.out << outcome.err);
  CHECK(outcome.code == 0);
  CHECK(outcome.out.find("equal to the first device (the variant is approximate) in every bit") != std::string::npos);
  std::istringstream rows(desk.read("row.json"));
  for (std::string line; std::getline(rows, line);) CHECK(json::parse(line)["error"]["depth_mismatch"] > 0);
}

TEST_CASE("Hits other than one are counted under commit=count") {
  Desk desk;
  desk.write("two.obj", tessera::test::twoTriangles());
  std::string summary;
  const json error = rowOf(desk, "render two.obj --size 64x48 --set commit=count --json row.json", &summary)["error"];
  CHECK(error["hit_count_not_one"] > 0);
  CHECK(summary.find("pixels hit, but not once: ") != std::string::npos);
  const json grid =
      rowOf(desk, "render 'generate:grid?angle=30' --size 300x200 --set commit=count --json row.json")["error"];
  CHECK(grid["hit_count_not_one"] == 0);  // each shared edge once
  const json twice = rowOf(desk,
                           "render 'generate:grid' --size 200x200 --set commit=count --set fill=inclusive --set "
                           "sub-pixel=0 --json row.json")["error"];
  CHECK(twice["hit_count_not_one"] > 1000);
}

TEST_CASE("A raster of values has its error and its range in the row and the same bits in parity") {
  Desk desk;
  desk.write(
      "field.ply",
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty int "
      "height\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n-1 -1 0.5 0\n1 -1 0.5 32767\n-1 1 "
      "0.5 0\n1 1 0.5 32767\n3 0 2 1\n3 1 2 3\n");
  desk.write(
      "field.toml",
      "size = [50, 20]\n[[mesh]]\nsource = \"field.ply\"\n[camera]\nmatrix = [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]\n");
  std::string summary;
  const json row =
      rowOf(desk, "render field.toml --attribute height --range -5,5 -o a.exr -o a.png --json row.json", &summary);
  CHECK(row["scene"]["attribute"] == json{{"name", "height"}, {"range", {-5, 5}}});
  CHECK(row["error"]["attribute_max"] < 6 * 0x1p-24 * 5 * 1.001);
  CHECK(row["error"]["attribute_rms"] <= row["error"]["attribute_max"]);
  CHECK(row["plan"]["attribute"]["kept"] == true);
  CHECK(summary.find("attribute height: error at most ") != std::string::npos);
  CHECK(summary.find(" of the range -5 to 5") != std::string::npos);
  REQUIRE(desk.tessera("render field.toml --attribute height -o b.exr").code == 0);
  const auto compared = desk.tessera("compare a.exr b.exr");
  CHECK(compared.code == 5);
  CHECK(compared.out.find("largest difference of the values 3") != std::string::npos);  // 32767 - 5, next to the edge

  const auto parity = desk.tessera("parity field.toml --attribute height --range -5,5 --json rows.json");
  INFO(parity.out << parity.err);
  CHECK(parity.code == 0);
  std::istringstream rows(desk.read("rows.json"));
  for (std::string line; std::getline(rows, line);) {
    const json error = json::parse(line)["error"];
    CHECK(error["attribute_mismatch"] == 0);
    CHECK(error["attribute_max"] == row["error"]["attribute_max"]);
  }
}
