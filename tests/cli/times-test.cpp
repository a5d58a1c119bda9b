// Times for people: a median that may be far off is warned of, and one that stands is not.
#include "host/cli/times.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "run-tessera.h"

using namespace tessera;

namespace {

measure::Run runOf(const std::vector<std::uint64_t>& totals) {
  measure::Run run;
  for (const std::uint64_t ns : totals) run.samples.push_back({.totalNs = ns, .stages = {}});
  return run;
}

}  // namespace

TEST_CASE("A median that may be off by more than a twentieth is warned of") {
  // Quartiles 2 and 4 ms, median 3: 1.57 * 2 / sqrt(5) / 3 is 0.468.
  const std::string wide = cli::timesWarning(runOf({1000000, 2000000, 3000000, 4000000, 5000000}));
  CHECK(wide.starts_with("warning: the frames took 1.00 to 5.00 ms: their median may be off by 47 %;"));
  CHECK(wide.ends_with("--repeat 5\n"));
  CHECK(std::count(wide.begin(), wide.end(), '\n') == 1);
  // Quartiles 3 ms -+ d, five frames: the bound is at d = 0.107 ms.
  const auto around = [](std::uint64_t d) { return runOf({2000000, 3000000 - d, 3000000, 3000000 + d, 9000000}); };
  CHECK(cli::timesWarning(around(106000)).empty());
  CHECK_FALSE(cli::timesWarning(around(107500)).empty());
  CHECK(cli::timesWarning(runOf({7})).empty());  // of which nothing is known
}

TEST_CASE("Render warns where its own samples are too far apart and nowhere else") {
  const test::Desk desk;
  bool warned = false;
  for (int i = 0; i < 100 && !warned; ++i) {  // frames of some microseconds: most runs are
    const auto outcome = desk.tessera("render generate:icosphere?level=1 --size 16x16 --repeat 3 --json - ");
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    measure::Run run = runOf(nlohmann::json::parse(outcome.out)["time_ns"]["samples"]);
    const std::string warning = cli::timesWarning(run);
    const std::size_t at = outcome.err.find("warning: the frames took");
    CHECK((at == std::string::npos ? "" : outcome.err.substr(at)) == warning);
    warned = !warning.empty();
  }
  CHECK(warned);
}
