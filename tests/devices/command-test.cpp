// The command with one more kind of devices: every command knows it by its registration alone.
#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/cli/run-tessera.h"

using nlohmann::json;
using tessera::test::Desk;

namespace {

bool says(const std::string& text, const std::string& part) {
  UNSCOPED_INFO(text);
  return text.find(part) != std::string::npos;
}

constexpr const char* kBall = "'generate:icosphere?level=2' --size 64x48";

}  // namespace

TEST_CASE("devices lists a registered kind with its probe and its notes") {
  Desk desk;
  const json all = json::parse(desk.tessera("devices --json").out);
  const auto found = std::ranges::find_if(all["devices"], [](const json& d) { return d["device"] == "mirror"; });
  REQUIRE(found != all["devices"].end());
  CHECK((*found)["probe"] == json{{"cpp", "passed"}});
  CHECK((*found)["threads"].is_number());
  CHECK(says(all["notes"].dump(), "the mirror is clean"));
  CHECK(says(desk.tessera("devices").out, "mirror: the mirror is clean\n"));
}

TEST_CASE("parity compares a registered kind with the others") {
  Desk desk;
  const auto outcome = desk.tessera(std::string("parity ") + kBall);
  INFO(outcome.err);
  CHECK(outcome.code == 0);
  CHECK(says(outcome.err, "mirror: the mirror is clean\n"));
  std::vector<std::string> lines;  // device, route
  std::istringstream text(outcome.out);
  for (std::string line; std::getline(text, line);)
    if (line.ends_with("equal")) {
      std::istringstream words(line);
      std::string device, route;
      words >> device >> route;
      lines.push_back(device + " " + route);
    }
  CHECK(std::ranges::count(lines, "cpu cpp") == 1);
  CHECK(std::ranges::count(lines, "mirror cpp") == 1);
  CHECK(std::ranges::count(lines, "vulkan:0 spirv") + std::ranges::count(lines, "vulkan:0 glsl") == 2);
  const auto spirv = desk.tessera(std::string("parity ") + kBall + " --device mirror --set route=spirv");
  CHECK(spirv.code == 2);
  CHECK(says(spirv.err, "--set route=spirv: no device that was named, or is here, takes it"));
}

TEST_CASE("render runs on a registered kind and writes the file that the CPU writes") {
  Desk desk;
  const auto row = desk.tessera(std::string("render ") + kBall + " --device mirror --threads 1 -o m.exr --json -");
  INFO(row.err);
  REQUIRE(row.code == 0);
  const json provenance = json::parse(row.out)["provenance"];
  CHECK(provenance["api"] == "mirror");
  CHECK(provenance["threads"] == 1);
  CHECK(provenance["device"].get<std::string>().starts_with("Mirror of "));
  CHECK(desk.tessera(std::string("render ") + kBall + " --device cpu -o c.exr").code == 0);
  CHECK((desk.read("m.exr") == desk.read("c.exr")));
}

TEST_CASE("Messages and completion name a registered kind") {
  Desk desk;
  CHECK(says(desk.tessera(std::string("render ") + kBall + " --device vulkan --threads 2").err,
             "--threads: only the CPU or mirror device takes it; --device cpu or mirror would"));
  CHECK(says(desk.tessera(std::string("render ") + kBall + " --device miror").err, "did you mean mirror?"));
  CHECK(says(desk.tessera("help render").out, "cpu, vulkan, mirror, vulkan:N"));
  CHECK(says(desk.tessera("complete -- render --device mir").out, "mirror"));
  CHECK(says(desk.tessera("variants --json").out, "\"devices\": \"CPU, mirror\""));
}

TEST_CASE("A sweep runs on a registered kind and varies its threads") {
  Desk desk;
  desk.write("s.toml",
             "title = \"T\"\nquestion = \"Q?\"\nsizes = [16]\nrounds = 2\ndevices = [\"mirror\", \"vulkan\"]\n"
             "threads = [1, 2]\n[scenes]\nball = \"generate:icosphere?level=1\"\n[axes]\ntile = [8, 16]\n");
  const auto expanded = desk.tessera("expand s.toml --no-estimate --json");
  INFO(expanded.err);
  const json cells = json::parse(expanded.out)["cells"];
  const auto count = [&](const std::string& device, unsigned threads) {
    return std::ranges::count_if(cells,
                                 [&](const json& c) { return c["device"] == device && c["threads"] == threads; });
  };
  CHECK(count("mirror", 1) == 3);  // the reference is there twice
  CHECK(count("mirror", 2) == 3);
  CHECK(count("vulkan", 0) == 3);
  CHECK(says(desk.tessera("expand s.toml --no-estimate").out, "ball@mirror  16x16  1 2"));
  const auto swept = desk.tessera("sweep s.toml --out results --devices mirror");
  INFO(swept.err);
  CHECK(swept.code == 0);
  const std::string rows = desk.read("results/rows.jsonl");
  CHECK(std::ranges::count(rows, '\n') == 6);
  CHECK(says(rows, "\"api\":\"mirror\""));
  desk.write("wrong.toml",
             "title = \"T\"\nquestion = \"Q?\"\nsizes = [16]\ndevices = [\"miror\"]\n"
             "[scenes]\nball = \"generate:icosphere?level=1\"\n");
  CHECK(says(desk.tessera("expand wrong.toml").err, "no device 'miror'; cpu, vulkan, mirror, vulkan:N or vulkan:NAME"));
}
