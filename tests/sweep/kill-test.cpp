// Sweeps that are stopped at any moment go on, and end as if they had not been.
#include <fmt/format.h>
#include <signal.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <fstream>
#include <thread>

#include "datasets/random.h"
#include "running.h"

using namespace tessera::test;

namespace {

constexpr unsigned kRounds = 120, kRepeats = 2;

/// Each sample once; and each round of each resumed session with its own sample of the reference and of its twin.
void checkSamples(const Desk& desk, const std::string& folder) {
  using Key = std::array<int, 3>;
  std::set<Key> samples;
  std::set<Key> seen;  // session, round, cell
  for (const Json& line : journalLines(desk, folder, "sample")) {
    const int cell = line["cell"], round = line["round"], repeat = line["repeat"], session = line["session"];
    if (!line.contains("again")) CHECK(samples.insert(Key{cell, round, repeat}).second);
    if (line.contains("again")) CHECK(cell < 2);  // the reference and its twin
    seen.insert({session, round, cell});
  }
  CHECK(samples.size() == 4 * kRounds * kRepeats);
  // The last round of a session may have been cut off before its reference had its turn.
  const int sessions = static_cast<int>(journalLines(desk, folder, "session").size());
  for (int session = 1; session < sessions; ++session) {
    std::set<int> rounds;
    for (const Key& key : seen)
      if (key[0] == session) rounds.insert(key[1]);
    if (session + 1 < sessions && !rounds.empty()) rounds.erase(*rounds.rbegin());
    for (const int round : rounds)
      for (const int cell : {0, 1}) {
        INFO("session " << session << ", round " << round << ", cell " << cell);
        CHECK(seen.contains(Key{session, round, cell}));
      }
  }
}

}  // namespace

TEST_CASE("A sweep killed twenty times ends with the rows of one that never was") {
  constexpr std::uint64_t kSeed = 20;
  INFO("seed " << kSeed);
  tessera::datasets::Random random(kSeed);
  Desk desk;
  desk.write("tile.toml", tileSweep(kRounds, kRepeats));
  const auto whole = desk.tessera("sweep tile.toml --out whole");
  INFO(whole.err);
  REQUIRE(whole.code == 0);
  const double bytes = static_cast<double>(sizeOf(desk, "whole/journal.jsonl"));

  for (int kill = 0; kill < 20; ++kill) {
    Running sweep(desk, "sweep tile.toml --out killed --resume");
    const auto grown = [&, from = sizeOf(desk, "killed/journal.jsonl")] {
      return static_cast<double>(sizeOf(desk, "killed/journal.jsonl")) - static_cast<double>(from);
    };
    if (kill % 4 == 0) {  // while it starts, if it is not too fast for that
      const auto moment =
          std::chrono::steady_clock::now() + std::chrono::microseconds(static_cast<int>(random.between(0, 150e3)));
      REQUIRE(sweep.until([&] { return std::chrono::steady_clock::now() > moment || grown() > bytes / 40; }));
    } else {  // while it runs, up to a 20th of all further on
      REQUIRE(sweep.until([&, bound = random.between(0, bytes / 20)] { return grown() > bound; }));
    }
    const pid_t worker = sweep.worker();
    sweep.signal(SIGKILL);
    INFO("kill " << kill << ": " << sweep.err());
    REQUIRE(sweep.wait() == 128 + SIGKILL);
    if (worker != 0) {  // it goes with its parent
      const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
      while (isAlive(worker) && std::chrono::steady_clock::now() < end)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      CHECK_FALSE(isAlive(worker));
    }
  }
  const auto last = desk.tessera("sweep tile.toml --out killed --resume");
  INFO(last.err);
  REQUIRE(last.code == 0);
  CHECK(timelessRows(desk, "killed") == timelessRows(desk, "whole"));
  CHECK(journalLines(desk, "killed", "session").size() > 10);
  checkSamples(desk, "killed");
  for (const Json& row : linesOf(desk, "killed/rows.jsonl")) {
    CHECK(row["time_ns"]["samples"].size() == kRounds * kRepeats);
    CHECK(row["time_ns"]["sessions"].back() > 0);
    CHECK(row["time_ns"].contains("again") <= (row["sweep"]["reference"] == true || row["sweep"]["twin"] == true));
  }
}

TEST_CASE("A sweep that is stopped by a signal keeps what it had") {
  Desk desk;
  desk.write("tile.toml", tileSweep(kRounds, kRepeats));
  for (const int number : {SIGINT, SIGTERM}) {
    const std::string folder = fmt::format("out{}", number);
    Running sweep(desk, "sweep tile.toml --out " + folder);
    REQUIRE(sweep.until([&] { return desk.read(folder + "/journal.jsonl").find("\"sample\"") != std::string::npos; }));
    const pid_t worker = sweep.worker();
    if (number == SIGINT)
      sweep.signalGroup(number);  // the worker, too, as from a terminal
    else
      sweep.signal(number);
    CHECK(sweep.wait() == 130);
    const std::string err = sweep.err();
    INFO(err);
    CHECK(err.find("--resume goes on with " + folder) != std::string::npos);
    CHECK((worker == 0 || !isAlive(worker)));
    const auto rows = linesOf(desk, folder + "/rows.jsonl");
    REQUIRE(rows.size() == 4);
    for (const auto& row : rows) CHECK(row["status"] == "ok");
    const auto resumed = desk.tessera("sweep tile.toml --resume --out " + folder);
    INFO(resumed.err);
    REQUIRE(resumed.code == 0);
    checkSamples(desk, folder);
  }
}

TEST_CASE("A torn last line is cut off and a sweep that has ended stays as it is") {
  Desk desk;
  desk.write("tile.toml", tileSweep(2, 1));
  REQUIRE(desk.tessera("sweep tile.toml --out out").code == 0);
  const std::string journal = desk.read("out/journal.jsonl");
  // As if it had been killed while it wrote the last sample.
  const std::size_t last = journal.rfind('\n', journal.size() - 2) + 1;
  desk.write("out/journal.jsonl", journal.substr(0, last + 40));
  std::filesystem::remove(desk.path() / "out/rows.jsonl");  // which comes with the end
  REQUIRE(desk.tessera("sweep tile.toml --out out --resume").code == 0);
  std::set<std::pair<int, int>> samples;
  for (const Json& line : journalLines(desk, "out", "sample"))
    if (!line.contains("again")) CHECK(samples.emplace(line["cell"], line["round"]).second);
  CHECK(samples.size() == 8);

  const std::string ended = desk.read("out/journal.jsonl"), itsRows = desk.read("out/rows.jsonl");
  std::filesystem::remove(desk.path() / "out/rows.jsonl");
  const auto outcome = desk.tessera("sweep tile.toml --out out --resume");
  CHECK(outcome.code == 0);
  CHECK(outcome.out.find("nothing was left to do") != std::string::npos);
  CHECK(desk.read("out/journal.jsonl") == ended);
  CHECK(desk.read("out/rows.jsonl") == itsRows);  // made of the journal alone
}
