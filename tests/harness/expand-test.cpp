// tessera expand: what it prints, for people and as JSON, and what it refuses.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "experiments/harness/survey.h"
#include "tests/cli/run-tessera.h"

using nlohmann::json;
using tessera::test::Desk;

namespace {

const std::string kSweep =
    "title = \"Tiles\"\nquestion = \"Which?\"\nsizes = [32]\nrounds = 2\nseed = 9\n%devices%[scenes]\n"
    "ball = \"generate:icosphere?level=1\"\nfan = \"generate:fan?count=20\"\n"
    "[axes]\nbinning = [\"exact\", \"none\"]\ntile = [8, 16]\n[quick]\nscenes = [\"fan\"]\n";

void write(const Desk& desk, const std::string& devices = "") {
  std::string text = kSweep;
  desk.write("a.toml", text.replace(text.find("%devices%"), 9, devices));
}

bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("expand lists jobs and variants and refusals for people") {
  Desk desk;
  write(desk);
  const auto outcome = desk.tessera("expand a.toml --no-estimate");
  INFO(outcome.out << outcome.err);
  CHECK(outcome.code == 0);
  CHECK(outcome.out.starts_with("Tiles\nWhich?\n"));
  CHECK(says(outcome.out, "ball@cpu  32x32  all          5        2\n"));
  CHECK(says(outcome.out, "    4  binning=exact tile=8  (reference, each twice)\n"));
  CHECK(says(outcome.out, "    2  binning=none tile=8                            all: "));
  CHECK(says(outcome.out, "10 cells, 4 of them refused; 2 rounds, each of 1 + 1 frames a cell; "));
  CHECK_FALSE(says(outcome.out, "about"));
  CHECK(says(desk.tessera("expand a.toml --no-estimate --quick").out, "5 cells, 2 of them refused"));
}

TEST_CASE("expand as JSON has what a scheduler needs") {
  Desk desk;
  write(desk, "devices = [\"cpu\", \"vulkan:no such device\"]\n");
  const auto outcome = desk.tessera("expand a.toml --json");
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  const json all = json::parse(outcome.out);
  CHECK(all["title"] == "Tiles");
  CHECK(all["sha256"].get<std::string>().size() == 64);
  CHECK(all["seed"] == 9);
  CHECK(all["estimate_s"] > 0);
  REQUIRE(all["jobs"].size() == 4);
  CHECK(all["jobs"][1] == json{{"name", "fan@cpu"}, {"scene", "fan"}, {"device", "cpu"}, {"cells", {5, 6, 7, 8, 9}}});
  REQUIRE(all["cells"].size() == 20);
  CHECK(all["cells"][1] == json{{"cell", 1},
                                {"job", "ball@cpu"},
                                {"group", 0},
                                {"asked", {{"binning", "exact"}, {"tile", "8"}}},
                                {"size", {32, 32}},
                                {"device", "cpu"},
                                {"threads", 0},
                                {"reference", false},
                                {"twin", true},
                                {"refused", nullptr}});
  CHECK(says(all["cells"][3]["refused"], "binning"));
  // Another machine may have the device.
  CHECK(says(all["cells"][10]["refused"], "no such device"));
  const auto unmeasured = desk.tessera("expand a.toml --json --no-estimate");
  CHECK(json::parse(unmeasured.out)["estimate_s"].is_null());
}

TEST_CASE("expand takes ratios from rows beside the sweep and says so") {
  Desk desk;
  write(desk);
  const auto last = [&] {
    const auto outcome = desk.tessera("expand a.toml");
    INFO(outcome.out << outcome.err);
    CHECK(outcome.code == 0);
    return outcome.out.substr(outcome.out.find("about"));
  };
  CHECK(says(last(), "if every other cell takes as long: no results.jsonl beside the sweep has ratios"));
  const auto row = [](const std::string& tile, bool reference, double ms) {
    return json{{"time_ns", {{"median", ms * 1e6}}},
                {"provenance", {{"cpu", "c"}, {"device", "d"}}},
                {"scene", {{"size", {2048, 2048}}}},
                {"sweep",
                 {{"scene", "ball"},
                  {"device", "cpu"},
                  {"threads", 0},
                  {"reference", reference},
                  {"asked", {{"binning", "exact"}, {"tile", tile}}}}}}
               .dump() +
           "\n";
  };
  desk.write("results.jsonl", "{\"kind\":\"run\"}\nnot JSON\n" + row("8", true, 2) + row("16", false, 2000000));
  const std::string counted = last();
  CHECK(says(counted, "the ratios of 1 of 2 other cells in results.jsonl; the rest count as their references"));
  CHECK(says(counted, " min here"));  // a million times its reference: the time limit's 60 s a frame
}

TEST_CASE("expand says which cells it could not measure") {
  Desk desk;
  desk.write(
      "a.toml",
      "title = \"T\"\nquestion = \"Q\"\nsizes = [64]\n[scenes]\nsoup = \"generate:soup?count=2000\"\n[set]\nbinning = "
      "\"queue\"\ncapacity = 16\n[axes]\noverflow = [\"error\", \"retry\"]\n");
  const auto outcome = desk.tessera("expand a.toml");
  INFO(outcome.out << outcome.err);
  CHECK(outcome.code == 0);
  CHECK(says(outcome.out, "3 cells are not counted, since their reference failed: "));
}

TEST_CASE("expand refuses a broken sweep in one line") {
  Desk desk;
  write(desk);
  desk.write("broken.toml", "title = \"T\"\n");
  desk.write("mesh.toml",
             "title = \"T\"\nquestion = \"Q\"\nsizes = [8]\n[scenes]\na = \"bad.obj\"\nb = \"generate:fan\"\n");
  desk.write("bad.obj", "v 1 2\n");
  for (const auto& [arguments, named] :
       std::vector<std::pair<std::string, std::string>>{{"none.toml", "none.toml: no such file"},
                                                        {"broken.toml", "broken.toml:1:1: question is missing"},
                                                        {"broken.toml --json", "broken.toml:1:1: question is missing"},
                                                        {"mesh.toml", "bad.obj:1"},
                                                        {"", "SWEEP"}}) {
    const auto outcome = desk.tessera("expand " + arguments);
    INFO(arguments << "\n" << outcome.out << outcome.err);
    CHECK(outcome.code == 2);
    CHECK(outcome.complainsOnce());
    CHECK(says(outcome.err, named));
  }
}

TEST_CASE("The first cell that is not refused is the reference unless the sweep names another") {
  Desk desk;
  const std::string sweep =
      "title = \"T\"\nquestion = \"Q\"\nsizes = [32]\n[scenes]\nball = \"generate:icosphere?level=1\"\n"
      "[axes]\nbinning = [\"none\", \"exact\"]\ntile = [8, 16]\n";
  desk.write("a.toml", sweep);
  const auto first = desk.tessera("expand a.toml --no-estimate");
  INFO(first.out << first.err);
  CHECK(says(first.out, "    2  binning=exact tile=8  (reference, each twice)\n"));
  const json all = json::parse(desk.tessera("expand a.toml --no-estimate --json").out);
  CHECK(all["cells"][1]["twin"] == true);
  CHECK(all["cells"][1]["asked"] == all["cells"][3]["asked"]);
  CHECK(all["cells"][3]["reference"] == true);
  CHECK(all["cells"][1]["refused"].is_null());
  desk.write("a.toml", sweep + "[reference]\nbinning = \"none\"\n");
  CHECK(says(desk.tessera("expand a.toml --no-estimate").out, "(reference, but refused: no ratios)"));
}

TEST_CASE("Cells share an image of the oracle where all image axes are alike, and only there") {
  const auto image = [](const tessera::Variant& variant) { return tessera::harness::imageText(variant); };
  CHECK(image({{"tile", "8"}, {"cull", "back"}}) == image({{"tile", "64"}, {"binning", "none"}, {"cull", "back"}}));
  CHECK(image({{"cull", "back"}}) != image({{"cull", "front"}}));
  CHECK(image({{"shade", "id"}}) != image({{"shade", "smooth"}}));
}
