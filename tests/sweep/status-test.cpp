// How a cell can end: each is a row with its reason, and the others go on.
#include <signal.h>

#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>

#include "running.h"

using namespace tessera::test;

namespace {

std::string head(const std::string& more) {
  return "title = \"Ends\"\nquestion = \"How do cells end?\"\nsizes = [64]\nthreads = [1]\n" + more;
}

/// The transform's own kernel with one line in place of another.
std::string transformWith(const std::string& old, const std::string& line) {
  std::ifstream file(TESSERA_SOURCE_DIR "/slang/stages/transform.slang");
  std::ostringstream text;
  text << file.rdbuf();
  std::string kernel = text.str();
  const std::size_t at = kernel.find(old);
  REQUIRE(at != std::string::npos);
  kernel.replace(at, old.size(), line);
  return kernel.substr(0, kernel.rfind("[shader"));  // without `project`: a file has one entry point
}

}  // namespace

TEST_CASE("Overflow is a status, and what drop loses is a list") {
  Desk desk;
  desk.write("ends.toml",
             head("rounds = 3\nrepeats = 2\n[scenes]\nsoup = \"generate:soup?count=500&pixels=200\"\n[set]\n"
                  "binning = \"queue\"\ncapacity = 16\ntile = 32\n[axes]\n"
                  "overflow = [\"retry\", \"drop\", \"error\"]\n[truth]\nsub-pixel = 4\n"));
  const auto outcome = desk.tessera("sweep ends.toml --out out");
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  const auto rows = linesOf(desk, "out/rows.jsonl");
  REQUIRE(rows.size() == 4);
  const Json &retry = rows[0], &drop = rows[2], &error = rows[3];
  CHECK(retry["status"] == "ok");
  CHECK(retry["error"]["id_mismatch"] == 0);
  CHECK(retry["truth"] == Json{{"sub-pixel", "4"}});
  CHECK(retry["truth_error"]["id_mismatch"] > 0);
  CHECK(sizeOf(desk, "out/" + retry["picture"].get<std::string>()) > 0);
  CHECK_FALSE(retry.contains("error_samples"));

  CHECK(drop["status"] == "ok");
  REQUIRE(drop["error_samples"]["id_mismatch"].size() == 6);
  std::vector<double> lost = drop["error_samples"]["id_mismatch"];
  std::sort(lost.begin(), lost.end());
  CHECK(lost.front() > 0);
  CHECK(drop["error"]["id_mismatch"] == (lost[2] + lost[3]) / 2);

  CHECK(error["status"] == "overflow");
  CHECK(error["message"].get<std::string>().find("capacity=16") != std::string::npos);
  CHECK_FALSE(error.contains("time_ns"));
  CHECK(outcome.out.find("3 ok, 1 overflow") != std::string::npos);
}

TEST_CASE("What the planner refuses is unsupported") {
  Desk desk;
  desk.write("ends.toml", head("rounds = 1\n[scenes]\nball = \"generate:icosphere?level=1\"\n[axes]\n"
                               "projection = [\"perspective\", \"orthographic\"]\n"));
  REQUIRE(desk.tessera("sweep ends.toml --out out").code == 0);
  const auto rows = linesOf(desk, "out/rows.jsonl");
  REQUIRE(rows.size() == 3);
  CHECK(rows[0]["status"] == "ok");
  CHECK(rows[2]["status"] == "unsupported");
  CHECK(rows[2]["message"].get<std::string>().find("w is not 1") != std::string::npos);
}

TEST_CASE("A kernel of a stage that the plan leaves out is unsupported") {
  Desk desk;
  desk.write("shade.slang", "[numthreads(1, 1, 1)] void shade() {}");
  desk.write("ends.toml", head("rounds = 1\n[scenes]\nball = \"generate:icosphere?level=1\"\n[kernels]\n"
                               "shade = [\"\", \"shade.slang\"]\n"));
  REQUIRE(desk.tessera("sweep ends.toml --out out").code == 0);
  const auto rows = linesOf(desk, "out/rows.jsonl");
  REQUIRE(rows.size() == 3);
  CHECK(rows[2]["status"] == "unsupported");
  CHECK(rows[2]["message"].get<std::string>().find("does not run such a stage") != std::string::npos);
}

TEST_CASE("Kernels that are wrong or hang or do not compile cost their own cell") {
  Desk desk;
  const std::string line = "clipSpace[v] = c;";
  desk.write("shifted.slang", transformWith(line, "c.x = c.x + 0.25 * c.w; " + line));
  desk.write("endless.slang", transformWith(line, line + " while (clipSpace[v].x < 3e38) clipSpace[v].x = 0;"));
  desk.write("broken.slang", transformWith(line, "nothing of the kind;"));
  desk.write("empty.slang", "");
  desk.write("ends.toml",
             head("rounds = 2\ntime-limit = 2\n[scenes]\nball = \"generate:icosphere?level=1\"\n[kernels]\n"
                  "transform = [\"\", \"shifted.slang\", \"endless.slang\", \"broken.slang\", \"empty.slang\"]\n"));
  const auto outcome = desk.tessera("sweep ends.toml --out out");
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  const auto rows = linesOf(desk, "out/rows.jsonl");
  REQUIRE(rows.size() == 6);
  const auto message = [&](std::size_t cell) { return rows[cell].value("message", ""); };
  for (const std::size_t own : {0, 1}) {
    CHECK(rows[own]["status"] == "ok");
    CHECK(rows[own]["time_ns"]["samples"].size() == 2);
  }
  CHECK(rows[2]["status"] == "error");
  CHECK(message(2).find("differs from the oracle") != std::string::npos);
  CHECK(rows[2]["error"]["coverage_mismatch"] > 0);
  CHECK(rows[2].contains("picture"));
  CHECK(rows[3]["status"] == "timeout");
  CHECK(message(3) == "a frame took longer than 2 s");
  CHECK(rows[3]["variant"]["binning"] != "");  // as the plan resolved it
  CHECK(rows[4]["status"] == "error");
  CHECK(message(4).find("broken.slang") != std::string::npos);
  CHECK(rows[5]["status"] == "error");
  CHECK(message(5).find("empty.slang): it has no compute entry point") != std::string::npos);
  for (const std::size_t bad : {2, 3, 4, 5}) CHECK_FALSE(rows[bad].contains("time_ns"));
}

TEST_CASE("A worker that is killed costs the cell that it was at") {
  Desk desk;
  desk.write("tile.toml", tileSweep(60, 2));
  Running sweep(desk, "sweep tile.toml --out out");
  REQUIRE(sweep.until([&] { return desk.read("out/journal.jsonl").find("\"sample\"") != std::string::npos; }));
  const pid_t worker = sweep.worker();
  REQUIRE(worker != 0);
  kill(worker, SIGSEGV);
  INFO(sweep.err());
  REQUIRE(sweep.wait() == 0);
  std::size_t ok = 0;
  for (const Json& row : linesOf(desk, "out/rows.jsonl")) {
    if (row["status"] == "ok") {
      CHECK(row["time_ns"]["samples"].size() == 120);
      ++ok;
    } else {
      CHECK(row["status"] == "error");
      CHECK(row["message"].get<std::string>().find("SIGSEGV") != std::string::npos);
    }
  }
  CHECK(ok == 3);
}

TEST_CASE("Where the reference is refused there is no ratio and where none is named another cell takes its place") {
  Desk desk;
  const std::string sweep = head(
      "rounds = 2\n[scenes]\nball = \"generate:icosphere?level=1\"\n[axes]\n"
      "projection = [\"orthographic\", \"perspective\"]\n");
  desk.write("first.toml", sweep);
  REQUIRE(desk.tessera("sweep first.toml --out first").code == 0);
  const auto rows = linesOf(desk, "first/rows.jsonl");
  REQUIRE(rows.size() == 3);
  CHECK(rows[0]["status"] == "unsupported");
  CHECK(rows[0]["sweep"]["reference"] == false);
  CHECK(rows[1]["sweep"]["twin"] == true);
  CHECK(rows[1]["sweep"]["asked"] == rows[2]["sweep"]["asked"]);
  CHECK(rows[2]["sweep"]["reference"] == true);
  for (const std::size_t timed : {1, 2}) CHECK(rows[timed]["time_ns"]["samples"].size() == 2);
  // What was begun so goes on so.
  const std::string journal = desk.read("first/journal.jsonl");
  desk.write("first/journal.jsonl", journal.substr(0, journal.rfind('\n', journal.size() - 2) + 1));
  std::filesystem::remove(desk.path() / "first/rows.jsonl");
  REQUIRE(desk.tessera("sweep first.toml --out first --resume").code == 0);
  CHECK(linesOf(desk, "first/rows.jsonl")[1]["sweep"] == rows[1]["sweep"]);

  desk.write("named.toml", sweep + "[reference]\nprojection = \"orthographic\"\n");
  const auto outcome = desk.tessera("sweep named.toml --out named");
  REQUIRE(outcome.code == 0);
  CHECK(outcome.out.find("0.000") == std::string::npos);
  CHECK(outcome.out.find("perspective ") != std::string::npos);
}
