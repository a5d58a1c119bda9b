// Rows: what they hold, and that they are the same again.
#include <catch2/catch.hpp>

#include "running.h"

using namespace tessera::test;

TEST_CASE("Two sweeps of one seed give the same rows but for times") {
  Desk desk;
  desk.write("tile.toml", tileSweep(3, 2));
  for (const std::string folder : {"a", "b"}) {
    const auto outcome = desk.tessera("sweep tile.toml --out " + folder);
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK(outcome.out.find("4 cells, 4 ok") != std::string::npos);
  }
  const auto rows = timelessRows(desk, "a");
  CHECK(rows == timelessRows(desk, "b"));
  REQUIRE(rows.size() == 4);

  // The order in which cells took their turns, too: all in a round, not the same in each.
  const auto turns = [&](const std::string& folder) {
    std::vector<Json> turns;
    for (const auto& line : journalLines(desk, folder, "sample"))
      turns.push_back({line["round"], line["cell"], line["repeat"]});
    return turns;
  };
  CHECK(turns("a") == turns("b"));
  std::set<std::vector<int>> orders;
  for (int round = 0; round < 3; ++round) {
    std::vector<int> order;
    for (const auto& turn : turns("a"))
      if (turn[0] == round && turn[2] == 0) order.push_back(turn[1]);
    CHECK(std::set(order.begin(), order.end()).size() == 4);
    orders.insert(order);
  }
  CHECK(orders.size() > 1);
}

TEST_CASE("A sweep's row says what it was and how to do it again") {
  Desk desk;
  desk.write("tile.toml", tileSweep(2, 2, "seed = 7"));
  REQUIRE(desk.tessera("sweep tile.toml --out out").code == 0);
  const auto rows = linesOf(desk, "out/rows.jsonl");
  REQUIRE(rows.size() == 4);
  std::size_t references = 0, twins = 0;
  for (const Json& row : rows) {
    CHECK(row["schema_version"] == 3);
    CHECK(row["status"] == "ok");
    CHECK(row["error"]["id_mismatch"] == 0);
    CHECK(row["counters"]["tests"] > 0);
    CHECK(row["memory"]["peak_buffer_bytes"] > 0);
    CHECK(row["provenance"]["seed"] == 7);
    CHECK(row["sweep"]["asked"]["commit"] == "tile-owned");
    CHECK(row["sweep"]["asked"]["tile"] == row["variant"]["tile"]);
    CHECK(row["sweep"]["swept"] == Json{"tile"});
    CHECK(row["sweep"]["sha256"].get<std::string>().size() == 64);
    CHECK(row["time_ns"]["samples"].size() == 4);
    CHECK(row["time_ns"]["rounds"] == Json{0, 0, 1, 1});
    CHECK(row["time_ns"]["sessions"] == Json{0, 0, 0, 0});
    CHECK(row["time_ns"]["clock"] == "wall");
    CHECK_FALSE(row["time_ns"].contains("again"));
    CHECK_FALSE(row.contains("picture"));
    references += row["sweep"]["reference"].get<bool>();
    twins += row["sweep"]["twin"].get<bool>();
  }
  CHECK(references == 1);
  CHECK(twins == 1);

  const std::string command = rows[3]["command"];
  REQUIRE(command.starts_with("tessera "));
  const auto again = desk.tessera(command.substr(8));
  INFO(again.err);
  REQUIRE(again.code == 0);
  const Json row = Json::parse(again.out);
  for (const char* const field : {"variant", "scene", "error", "counters", "plan"}) CHECK(row[field] == rows[3][field]);
}

TEST_CASE("Jobs are done apart and a quick sweep is a smaller one") {
  Desk desk;
  const std::string sweep =
      "title = \"Two\"\nquestion = \"?\"\nsizes = [64, 32]\nthreads = [1]\nrounds = 3\n[scenes]\n"
      "ball = \"generate:icosphere?level=1\"\nsoup = \"generate:soup?count=20\"\n[axes]\ntile = [8, 16]\n"
      "[quick]\nsizes = [32]\nrounds = 1\n";
  desk.write("two.toml", sweep);
  REQUIRE(desk.tessera("sweep two.toml --out all").code == 0);
  std::vector<Json> parts;
  for (const std::string job : {"ball@cpu", "soup@cpu"}) {
    REQUIRE(desk.tessera("sweep two.toml --out " + job + " --job " + job).code == 0);
    for (const auto& row : timelessRows(desk, job)) parts.push_back(row);
  }
  CHECK(parts == timelessRows(desk, "all"));
  CHECK(desk.tessera("sweep two.toml --out soup@cpu --job ball@cpu --resume").complainsOnce());

  REQUIRE(desk.tessera("sweep two.toml --out quick --quick").code == 0);
  const auto rows = linesOf(desk, "quick/rows.jsonl");
  REQUIRE(rows.size() == 6);
  for (const auto& row : rows) CHECK(row["scene"]["size"] == Json{32, 32});
  for (const auto& row : rows) CHECK(row["time_ns"]["samples"].size() == 1);
}
