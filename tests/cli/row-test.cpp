// The statistics of a row, on figures worked out by hand.
#include "host/measure/row.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/support/streams.h"

using namespace tessera;
using namespace tessera::test;

TEST_CASE("Order statistics of a sample") {
  CHECK(measure::spread({}).median == 0);
  CHECK(measure::spread({7}).median == 7);
  CHECK(measure::spread({7}).iqr == 0);
  const measure::Spread even = measure::spread({4, 1, 3, 2});  // quartiles 1.75 and 3.25
  CHECK(even.median == 2.5);
  CHECK(even.min == 1);
  CHECK(even.iqr == 1.5);
}

TEST_CASE("Stage medians keep the pipeline's order") {
  const std::vector<FrameTimes> samples{
      {10, {{"setup", 1}, {"bin", 9}}}, {12, {{"setup", 3}, {"bin", 9}}}, {11, {{"setup", 2}, {"bin", 9}}}};
  const auto medians = measure::stageMedians(samples);
  REQUIRE(medians.size() == 2);
  CHECK(medians[0] == std::pair<std::string, double>{"setup", 2});
  CHECK(medians[1] == std::pair<std::string, double>{"bin", 9});
  CHECK(measure::totalSpread(samples).median == 11);
}

TEST_CASE("A row holds what applies and leaves out what does not") {
  Scene scene;
  scene.name = "broken \xff name";
  measure::Run run;
  run.scene = &scene;
  run.status = measure::statusOf(ExitCode::kUnsupported);
  run.message = "no 64-bit atomics";
  const auto bare = nlohmann::json::parse(measure::rowText(run));
  CHECK(bare["status"] == "unsupported");
  for (const char* const absent : {"time_ns", "error", "counters", "plan", "memory"})
    CHECK_FALSE(bare.contains(absent));
  CHECK_FALSE(bare["scene"].contains("attribute"));
  CHECK_FALSE(bare["scene"].contains("notes"));
  scene.notes = {"a.obj: 2 polygons are not convex"};
  CHECK(nlohmann::json::parse(measure::rowText(run))["scene"]["notes"] ==
        nlohmann::json{"a.obj: 2 polygons are not convex"});

  run.difference = Difference{};
  run.difference->psnr = std::numeric_limits<double>::infinity();
  run.samples.push_back({5, {}});
  const auto full = nlohmann::json::parse(measure::rowText(run));
  for (const char* const null : {"coverage_mismatch", "id_mismatch", "depth_mismatch", "hit_count_mismatch",
                                 "attribute_mismatch", "colour_mismatch", "depth_max_abs", "psnr"})
    CHECK(full["error"].at(null).is_null());
  CHECK(full["time_ns"]["median"] == 5);
  for (const char* const absent : {"hit_count_not_one", "attribute_max", "attribute_rms"})
    CHECK_FALSE(full["error"].contains(absent));
}

TEST_CASE("A row holds errors with an oracle and without") {
  Scene scene;
  attributeOf(scene) = {1};
  nameAttribute(scene, "height");
  measure::Run run;
  run.scene = &scene;
  run.hitCountNotOne = 3;
  run.attributeError = oracle::AttributeError{.max = 0.5, .rms = 0.25, .pixels = 1};
  run.attributeRange = ValueRange{-1, 2};
  const auto row = nlohmann::json::parse(measure::rowText(run));
  CHECK(row["error"] == nlohmann::json{{"hit_count_not_one", 3}, {"attribute_max", 0.5}, {"attribute_rms", 0.25}});
  CHECK(row["scene"]["attribute"] == nlohmann::json{{"name", "height"}, {"range", {-1, 2}}});
  run.attributeError->max = std::numeric_limits<double>::infinity();
  CHECK(nlohmann::json::parse(measure::rowText(run))["error"].at("attribute_max").is_null());
}

TEST_CASE("Covered pixels are counted by ids or by hits") {
  Framebuffer frame{
      .width = 2, .height = 2, .depth = {}, .ids = {0, kNoTriangle, 3, kNoTriangle}, .hits = {}, .colour = {}};
  CHECK(measure::coveredPixels(frame) == 2);
  frame.ids[1] = kUnknownTriangle;
  CHECK(measure::coveredPixels(frame) == 3);
  frame.ids.clear();
  frame.hits = {0, 2, 1, 1};
  CHECK(measure::coveredPixels(frame) == 3);
}
