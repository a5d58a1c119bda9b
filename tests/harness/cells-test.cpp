// A sweep's cells: their order, their reference and its twin, their commands, and the order of a round.
#include "experiments/harness/cells.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <numeric>

#include "tests/cli/run-tessera.h"

using namespace tessera;
using namespace tessera::harness;
using tessera::test::Desk;

namespace {

Sweep read(const Desk& desk, const std::string& rest, const std::string& top = "") {
  desk.write("a.toml", "title = \"T\"\nquestion = \"Q\"\nsizes = [64, [32, 16]]\n" + top +
                           "[scenes]\nz = \"generate:fan\"\na = \"generate:fan\"\n" + rest);
  return readSweep(desk.path() / "a.toml");
}

std::vector<std::string> namesOf(const Sweep& sweep) {
  std::vector<std::string> names;
  for (const SweepPoint& cell : cells(sweep)) names.push_back(cellName(sweep, cell));
  return names;
}

}  // namespace

TEST_CASE("Cells are devices then scenes then sizes then threads then the product") {
  Desk desk;
  const Sweep sweep = read(desk, "[axes]\ntile = [16, 8]\nbinning = [\"exact\", \"bitmask\"]\n",
                           "devices = [\"vulkan\", \"cpu\"]\nthreads = [1, 2]\n");
  const auto all = cells(sweep);
  const auto names = namesOf(sweep);
  // Threads are the CPU device's: 2 scenes x 2 sizes x (1 + 2) groups, each of 4 cells and a twin.
  REQUIRE(all.size() == 2 * 2 * 3 * 5);
  CHECK(names[0] == "z 64x64 vulkan, tile=16 binning=exact");
  CHECK(names[1] == "z 64x64 vulkan, tile=16 binning=exact (again)");
  CHECK(names[2] == "z 64x64 vulkan, tile=16 binning=bitmask");
  CHECK(names[3] == "z 64x64 vulkan, tile=8 binning=exact");
  CHECK(names[5] == "z 32x16 vulkan, tile=16 binning=exact");
  CHECK(names[10] == "a 64x64 vulkan, tile=16 binning=exact");
  CHECK(names[20] == "z 64x64 cpu 1 thread, tile=16 binning=exact");
  CHECK(names[25] == "z 64x64 cpu 2 threads, tile=16 binning=exact");
  for (std::size_t i = 0; i < all.size(); ++i) {
    CHECK(all[i].number == i);
    CHECK(all[i].group == i / 5);
    CHECK(all[i].reference == (i % 5 == 0));
    CHECK(all[i].twin == (i % 5 == 1));
  }
  CHECK(all[0].labels == all[1].labels);

  const auto all4 = jobs(sweep, all);
  REQUIRE(all4.size() == 4);
  CHECK((all4[0].name == "z@vulkan" && all4[1].name == "a@vulkan" && all4[2].name == "z@cpu"));
  CHECK((all4[2].cells.size() == 20 && all4[2].cells.front() == 20 && all4[2].cells.back() == 39));
}

TEST_CASE("The reference and its twin stand where the reference's values are") {
  Desk desk;
  const std::string axes = "[axes]\ntile = [8, 16]\nedge = [\"int32\", \"int64\"]\n";
  const auto referenceOf = [&](const std::string& rest) {
    const Sweep sweep = read(desk, axes + rest);
    const auto all = cells(sweep);
    std::string name;
    std::size_t references = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (!all[i].reference) continue;
      ++references;
      REQUIRE(i + 1 < all.size());
      CHECK(all[i + 1].twin);
      CHECK(all[i + 1].labels == all[i].labels);
      name = variantName(sweep, all[i]);
    }
    CHECK(references == 4);
    CHECK(static_cast<std::size_t>(std::ranges::count_if(all, &SweepPoint::twin)) == references);
    return name;
  };
  CHECK(referenceOf("") == "tile=8 edge=int32");
  CHECK(referenceOf("[reference]\nedge = \"int64\"\n") == "tile=8 edge=int64");
  CHECK(referenceOf("[reference]\ntile = 16\nedge = \"int64\"\n") == "tile=16 edge=int64");
  CHECK(referenceOf("[[leave-out]]\ntile = 8\nedge = \"int32\"\n") == "tile=8 edge=int64");
  CHECK(referenceOf("[[also]]\nbinning = \"none\"\n[reference]\nbinning = \"none\"\n") == "binning=none");
}

TEST_CASE("Combinations are left out and single ones come last") {
  Desk desk;
  desk.write("mine.comp", "");
  const Sweep sweep =
      read(desk,
           "[set]\ncull = \"back\"\n[axes]\ntile = [8, 16]\nedge = [\"int32\", \"int64\"]\n"
           "[kernels]\nshade = [\"\", \"mine.comp\"]\n"
           "[[leave-out]]\ntile = 8\nedge = [\"int64\"]\n[[leave-out]]\n\"kernel:shade\" = \"mine.comp\"\n"
           "tile = 16\n[[also]]\nedge = \"float64\"\n");
  const auto all = combinations(sweep);
  const std::vector<Labels> expected{
      {{"cull", "back"}, {"tile", "8"}, {"edge", "int32"}, {"kernel:shade", ""}},
      {{"cull", "back"}, {"tile", "8"}, {"edge", "int32"}, {"kernel:shade", "mine.comp"}},
      {{"cull", "back"}, {"tile", "16"}, {"edge", "int32"}, {"kernel:shade", ""}},
      {{"cull", "back"}, {"tile", "16"}, {"edge", "int64"}, {"kernel:shade", ""}},
      {{"cull", "back"}, {"edge", "float64"}, {"kernel:shade", ""}},
  };
  CHECK(all == expected);
  const auto made = cells(sweep);
  CHECK(made[0].kernels.empty());
  CHECK(made[2].kernels == KernelFiles{{"shade", desk.path() / "mine.comp"}});
  CHECK(made[2].asked.text() == "cull=back tile=8 edge=int32");
  CHECK(cellName(sweep, made[2]) == "z 64x64 cpu, tile=8 edge=int32 kernel:shade=mine.comp");
}

TEST_CASE("A cell's command does what the cell does from the sweep's folder") {
  Desk desk;
  desk.write("two o'clock.obj", tessera::test::twoTriangles());
  desk.write("a.toml",
             "title = \"T\"\nquestion = \"Q\"\nsizes = [[40, 30]]\nthreads = [1]\nrounds = 3\nrepeats = 2\n[scenes]\n"
             "values = {source = \"two o'clock.obj\", attribute = \"z\", range = [-1, 0.5]}\n"
             "[set]\nsub-pixel = 4\n[axes]\ncommit = [\"depth32+id32\"]\n[kernels]\nsetup = [\"" TESSERA_SOURCE_DIR
             "/slang/stages/setup.slang\"]\n");
  const Sweep sweep = readSweep(desk.path() / "a.toml");
  const std::string command = cellCommand(sweep, cells(sweep)[0]);
  CHECK(command ==
        "tessera render 'two o'\\''clock.obj' --size 40x30 --device cpu --threads 1 --set sub-pixel=4 --set "
        "commit=depth32+id32 --kernel setup=" TESSERA_SOURCE_DIR
        "/slang/stages/setup.slang --attribute z --range -1,0.5 --repeat 6 --error --json -");
  const auto outcome = desk.tessera(command.substr(std::string("tessera ").size()));
  INFO(outcome.err);
  CHECK(outcome.code == 0);
  CHECK(outcome.out.find("\"size\":[40,30]") != std::string::npos);
  CHECK(outcome.out.find("\"range\":[-1.0,0.5]") != std::string::npos);
}

TEST_CASE("The order of a round is a permutation that seed and job and round decide") {
  std::vector<std::size_t> cells(50);
  std::iota(cells.begin(), cells.end(), 100u);
  const auto order = turnOrder(cells, 1, "a@cpu", 0);
  CHECK(order != cells);
  CHECK(std::ranges::is_permutation(order, cells));
  CHECK(turnOrder(cells, 1, "a@cpu", 0) == order);
  CHECK(turnOrder(cells, 1, "a@cpu", 1) != order);
  CHECK(turnOrder(cells, 2, "a@cpu", 0) != order);
  CHECK(turnOrder(cells, 1, "b@cpu", 0) != order);
  // The same on every machine, now and later: a sweep that goes on elsewhere has the same rounds.
  CHECK(turnOrder({0, 1, 2, 3, 4, 5, 6, 7}, 1, "a@cpu", 0) == std::vector<std::size_t>{7, 2, 6, 0, 5, 3, 1, 4});
  // Each place is as likely as the others: 8 places, 8000 rounds; a standard deviation is some 30.
  std::vector<int> first(8);
  for (unsigned round = 0; round < 8000; ++round) ++first[turnOrder({0, 1, 2, 3, 4, 5, 6, 7}, 1, "a@cpu", round)[0]];
  for (const int count : first) CHECK(std::abs(count - 1000) < 150);
}
