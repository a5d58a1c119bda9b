// sweep.toml: what it says when it is right, and the one line that each mistake gets, with its place.
#include "experiments/harness/sweep-file.h"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <sstream>

#include "tests/cli/run-tessera.h"
#include "tests/support/error-line.h"

using namespace tessera;
using namespace tessera::harness;
using tessera::test::Desk;

namespace {

const std::vector<std::string> kGood{
    "title = \"T\"", "question = \"Q\"", "sizes = [64]", "[scenes]", "ball = \"generate:icosphere?level=1\"",
    "[axes]",        "tile = [8, 16]"};

/// The good file with line `line` (from 1) replaced, or with `text` after its end.
std::string with(std::size_t line, const std::string& text) {
  std::string all;
  for (std::size_t i = 0; i < kGood.size(); ++i) all += (i + 1 == line ? text : kGood[i]) + "\n";
  return line > kGood.size() ? all + text + "\n" : all;
}

constexpr std::size_t kEnd = 8;  // the first line of what is appended

Sweep read(const Desk& desk, const std::string& text, bool quick = false) {
  desk.write("a.toml", text);
  return readSweep(desk.path() / "a.toml", quick);
}

/// The message, from the file's name on.
std::string mistake(const Desk& desk, const std::string& text, bool quick = false) {
  const std::string line = test::lineOf(ExitCode::kUsage, [&] { read(desk, text, quick); });
  const std::string start = (desk.path() / "a.toml").string();
  REQUIRE(line.starts_with(start));
  return line.substr(start.size());
}

void writeMeshes(const Desk& desk) {
  desk.write("two.obj", tessera::test::twoTriangles());
  desk.write("mine.comp", "");
  desk.write("mine.txt", "");
}

}  // namespace

TEST_CASE("A mistake in a sweep file is one line with its place and key") {
  struct Mistake {
    std::size_t line;
    std::string text, said;
  };
  const std::vector<Mistake> mistakes{
      // top level
      {1, "", ":1:1: title is missing"},
      {1, "title = 3", ":1:9: title: a line of text"},
      {1, "title = \"\"", ":1:9: title: a line of text"},
      {2, "", ":1:1: question is missing"},
      {3, "", ":1:1: sizes is missing"},
      {1, "title = \"T\"\ncolour = 3", ":2:1: a sweep has no key 'colour'; there are title, question"},
      {1, "title = \"T", ":1:11: "},
      // sizes
      {3, "sizes = []", ":3:9: sizes: a list of edges"},
      {3, "sizes = 64", ":3:9: sizes: a list of edges"},
      {3, "sizes = [0]", ":3:10: sizes: a whole number of pixels from 1 to 32768"},
      {3, "sizes = [64, 40000]", ":3:14: sizes: a whole number of pixels"},
      {3, "sizes = [64.5]", ":3:10: sizes: a whole number of pixels"},
      {3, "sizes = [[64]]", ":3:10: sizes: [width, height]"},
      {3, "sizes = [64, [64, 64]]", ":3:14: sizes: is there twice"},
      // numbers
      {3, "sizes = [64]\nrounds = 0", ":4:10: rounds: a whole number from 1 to 1000"},
      {3, "sizes = [64]\nrounds = 2.5", ":4:10: rounds: a whole number"},
      {3, "sizes = [64]\nwarm-up = -1", ":4:11: warm-up: a whole number from 0"},
      {3, "sizes = [64]\nrepeats = \"2\"", ":4:11: repeats: a whole number"},
      {3, "sizes = [64]\nseed = -1", ":4:8: seed: a whole number"},
      {3, "sizes = [64]\ntime-limit = 0", ":4:14: time-limit: seconds above 0"},
      {3, "sizes = [64]\ntime-limit = inf", ":4:14: time-limit: a finite number"},
      {3, "sizes = [64]\nthreads = [5000]", ":4:12: threads: a whole number from 0 (all cores) to 4096"},
      {3, "sizes = [64]\nthreads = [1, 1]", ":4:15: threads: is there twice"},
      {3, "sizes = [64]\ndevices = []", ":4:11: devices: a list"},
      {3, "sizes = [64]\ndevices = [\"gpu\"]", ":4:12: devices: no device 'gpu'; cpu, vulkan"},
      {3, "sizes = [64]\ndevices = [\"vulkan:a/b\"]", ":4:12: devices: no device"},
      {3, "sizes = [64]\ndevices = [\"cpu\", \"cpu\"]", ":4:19: devices: is there twice"},
      // scenes
      {5, "", ":4:1: scenes: at least one scene"},
      {5, "\"a/b\" = \"generate:fan\"", ":5:1: scenes.a/b: a scene's name"},
      {5, "\"..\" = \"generate:fan\"", ":5:1: scenes...: a scene's name"},
      {5, "ball = 3", ":5:8: scenes.ball: an input"},
      {5, "ball = \"generate:ball\"", ":5:8: scenes.ball: generate:ball: no such generator"},
      {5, "ball = \"generate:icosphere?level=12\"", ":5:8: scenes.ball: generate:icosphere"},
      {5, "ball = \"none.obj\"", ":5:8: scenes.ball: "},
      {5, "ball = \"/none/none.obj\"", ":5:8: scenes.ball: /none/none.obj: no such file"},
      {5, "ball = \"mine.txt\"", ":5:8: scenes.ball: 'mine.txt': generate:NAME, mesh:NAME or a file"},
      {5, "ball = \"mesh:../x\"", ":5:8: scenes.ball: mesh:../x: not a name"},
      {5, "ball = \"mesh:no-such-mesh\"", ":5:8: scenes.ball: mesh:no-such-mesh: no such mesh; "},
      {5, "ball = {x = 3}", ":5:8: scenes.ball.source is missing"},
      {5, "ball = {source = \"two.obj\", y = 3}", ":5:29: a scene has no key 'y'"},
      {5, "ball = {source = \"two.obj\", x = nan}", ":5:33: scenes.ball.x: a finite number"},
      {5, "ball = {source = \"generate:fan\", attribute = \"heat\"}",
       ":5:46: scenes.ball.attribute: a generator has no"},
      {5, "ball = {source = \"two.obj\", range = [0, 1]}", ":5:37: scenes.ball.range: there is no attribute"},
      {5, "ball = {source = \"two.obj\", attribute = \"z\", range = [1, 1]}",
       ":5:54: scenes.ball.range: two different"},
      {5, "ball = {source = \"two.obj\", attribute = \"z\", range = [0, 1e99]}", ":5:54: scenes.ball.range: two"},
      {4, "[scenes]\n[scenes]", ":5:"},
      // axes
      {7, "tyle = [8]", ":7:1: axes.tyle: no such axis; did you mean tile? There are route, plan"},
      {7, "tile = []", ":7:8: axes.tile: a list of values"},
      {7, "tile = 8", ":7:8: axes.tile: a list of values"},
      {7, "tile = [8, 9]", ":7:12: axes.tile: no value '9'; there are 8, 16, 32, 64"},
      {7, "tile = [8, 8]", ":7:12: axes.tile: '8' is there twice"},
      {7, "tile = [8, \"8\"]", ":7:12: axes.tile: '8' is there twice"},
      {7, "tile = [true]", ":7:9: axes.tile: a value's name"},
      {7, "capacity = [8]", ":7:13: axes.capacity: no value '8'; a whole number from 16 to 65536"},
      {7, "capacity = [16, \"016\"]", ":7:17: axes.capacity: '16' is there twice"},
      {7, "capacity = {from = 16}", ":7:12: axes.capacity.to is missing"},
      {7, "capacity = {from = 16, to = 64}", ":7:12: axes.capacity: either times"},
      {7, "capacity = {from = 16, to = 64, times = 2, step = 2}", ":7:12: axes.capacity: either times"},
      {7, "capacity = {from = 64, to = 16, times = 2}", ":7:12: axes.capacity: no value from 64 to 16"},
      {7, "capacity = {from = 16, to = 64, times = 1}", ":7:41: axes.capacity.times: a whole number from 2"},
      {7, "capacity = {from = 0, to = 64, times = 2}", ":7:12: axes.capacity: from 0 times"},
      {7, "capacity = {from = 16, to = 60000, step = 1}", ":7:12: axes.capacity: more than 1000 values"},
      {7, "capacity = {from = 16, to = 64, by = 2}", ":7:33: the range of capacity has no key 'by'"},
      {7, "tile = {from = 8, to = 32, step = 8}", ":7:8: axes.tile: no value '24'"},
      {7, "tile = [8, 16]\n[set]\ntile = 8", ":7:1: axes.tile: is in [set], too"},
      {kEnd, "[set]\nedge = [\"int32\"]", ":9:8: set.edge: a value's name"},
      {kEnd, "[set]\nedge = \"int16\"", ":9:8: set.edge: no value 'int16'"},
      {kEnd, "[[set]]\nedge = \"int32\"", ":8:1: set: [set] would be right"},
      {7,
       "capacity = {from = 16, to = 2000, step = 2}\ntile = [8, 16, 32, 64]\nedge = [\"int32\", \"int64\"]\nstep = "
       "[\"direct\", \"incremental\"]\ncull = [\"none\", \"back\", \"front\"]\nsub-pixel = [0, 4, 6, 8]",
       ":6:1: axes: 190656 cells before any is left out; at most 100000"},
      // kernels
      {kEnd, "[kernels]\nshadow = [\"\"]", ":9:1: kernels.shadow: no such stage"},
      {kEnd, "[kernels]\nshade = \"mine.comp\"", ":9:9: kernels.shade: a list"},
      {kEnd, "[kernels]\nshade = [\"\", \"other.comp\"]", ":9:14: kernels.shade: "},
      {kEnd, "[kernels]\nshade = [\"mine.txt\"]", ":9:10: kernels.shade: "},
      {kEnd, "[kernels]\nshade = [\"mine.comp\", \"mine.comp\"]", ":9:23: kernels.shade: is there twice"},
      // choices among the cells
      {kEnd, "[[leave-out]]\nedge = \"int32\"", ":9:1: leave-out.edge: does not vary in this sweep; there is tile"},
      {kEnd, "[[leave-out]]\ntile = 32", ":9:8: leave-out.tile: no cell has '32'; there are 8, 16"},
      {kEnd, "[[leave-out]]\ntile = []", ":9:8: leave-out.tile: a value, or a list"},
      {kEnd, "[[leave-out]]", ":8:1: leave-out: leaves out everything"},
      {kEnd, "[leave-out]\ntile = 8", ":8:1: leave-out: [[leave-out]]"},
      {kEnd, "[[leave-out]]\ntile = [8, 16]", ":6:1: leave-out: no cell is left"},
      {kEnd, "[[also]]\ntile = 9", ":9:8: also.tile: no value '9'"},
      {kEnd, "[[also]]\ntile = 8", ":8:1: also: the sweep has this cell already"},
      {kEnd, "[[also]]\nedge = \"int32\"\n[set]\nedge = \"int32\"", ":9:1: also.edge: is in [set], too"},
      {kEnd, "[reference]\nedge = \"int32\"", ":9:1: reference.edge: does not vary"},
      {kEnd, "[reference]\ntile = 32", ":9:8: reference.tile: no cell has '32'"},
      {kEnd, "[reference]\ntile = [8, 16]", ":9:8: reference.tile: one value"},
      {kEnd, "[reference]\ntile = 8\n[[leave-out]]\ntile = 8", ":8:1: reference: no cell has these values"},
      {kEnd, "[truth]\ntile = 8", ":9:1: truth.tile: does not change what is right; there are sub-pixel, cull, fill"},
      {kEnd, "[truth]\nshade = \"flat\"", ":9:1: truth.shade: does not change what is right"},
      {kEnd, "[truth]\nfill = \"left\"", ":9:8: truth.fill: no value 'left'"},
      // for the report
      {kEnd, "[plot]\ncurves = [\"tile\"]",
       ":9:1: [plot] has no key 'curves'; did you mean curve? There are curve, against"},
      {kEnd, "[plot]\ncurve = [\"edge\"]", ":9:10: plot.curve: no 'edge'; there are tile, scene, size"},
      {kEnd, "[plot]\ncurve = \"tile\"", ":9:9: plot.curve: a list of names"},
      {kEnd, "[plot]\nagainst = [\"tile\", \"tile\"]", ":9:20: plot.against: 'tile' is there twice"},
      {kEnd, "[plot]\nagainst = [\"x\"]", ":9:12: plot.against: no 'x'; there are tile, scene, size"},
      {kEnd, "[plot]\nheat = [\"tile\", \"size\"]", ":9:9: plot.heat: two axes in brackets"},
      {kEnd, "[plot]\nheat = [[\"tile\", \"tile\"]]", ":9:9: plot.heat: an axis against itself"},
      {kEnd, "[plot]\nerror = \"flaws\"", ":9:9: plot.error: no 'flaws'; there are coverage_mismatch, id_mismatch"},
      {kEnd, "[plot]\nerror = \"psnr\"", ":9:9: plot.error: no 'psnr'; there are coverage_mismatch, id_mismatch"},
      {kEnd, "[plot]\nx-label = 3", ":9:11: plot.x-label: a line of text"},
      {kEnd, "[[expect]]\nstatus = \"fine\"", ":9:10: expect.status: no 'fine'; there are ok, overflow"},
      {kEnd, "[[expect]]\nstatus = [\"ok\", \"fine\"]", ":9:17: expect.status: no 'fine'; there are ok"},
      {kEnd, "[[expect]]\nwhere = {tile = 8}", ":8:1: expect: says nothing of a row"},
      {kEnd, "[[expect]]\nstatus = \"ok\"\nwhere = {tile = 32}", ":10:17: expect.where.tile: no cell has '32'"},
      {kEnd, "[[expect]]\nstatus = \"ok\"\nscene = \"cube\"", ":10:9: expect.scene: no 'cube'; there is ball"},
      {kEnd, "[[expect]]\nerror.flaws = 0", ":9:7: expect.error.flaws: no such field"},
      {kEnd, "[[expect]]\nerror.id_mismatch = \"none\"", ":9:21: expect.error.id_mismatch: a number, or a comparison"},
      {kEnd, "[[expect]]\nerror.id_mismatch = \"= 0\"", ":9:21: expect.error.id_mismatch: a number, or a comparison"},
      {kEnd, "[[expect]]\nerror.id_mismatch = \">0\"", ":9:21: expect.error.id_mismatch: a number, or a comparison"},
      {kEnd, "[[expect]]\nerror.id_mismatch = \"\"", ":9:21: expect.error.id_mismatch: a number, or a comparison"},
      {kEnd, "[[expect]]\ntruth_error.id_mismatch = 0", ":9:1: expect.truth_error: there is no [truth]"},
      {kEnd, "[[expect]]\ncounters.pices = 0", ":9:10: expect.counters.pices: no such field; did you mean pieces?"},
      {kEnd, "[quick]\nseed = 3", ":9:1: [quick] has no key 'seed'"},
      {kEnd, "[quick]\nscenes = [\"cube\"]", ":9:11: quick.scenes: no scene 'cube'"},
      {kEnd, "[quick]\nsizes = []", ":9:9: quick.sizes: a list"},
  };
  Desk desk;
  writeMeshes(desk);
  for (const Mistake& m : mistakes) {
    INFO(m.text);
    const std::string said = mistake(desk, with(m.line, m.text));
    INFO(said);
    CHECK(said.starts_with(m.said));
  }
  CHECK(mistake(desk, with(kEnd, ""), true) == ": quick: there is no [quick] with the sizes and rounds of a quick run");
  CHECK(mistake(desk, "") == ": is empty");
}

TEST_CASE("A sweep file is read as it says") {
  Desk desk;
  writeMeshes(desk);
  const std::string text = R"(title = "T"
question = "Q"
sizes = [64, [32, 16]]
devices = ["cpu", "vulkan:llvmpipe"]
threads = [2, 1]
rounds = 3
warm-up = 0
repeats = 2
time-limit = 0.5
seed = 7
[scenes]
z-first = "two.obj"
a.b = "generate:fan"
values = {source = "two.obj", x = 2, attribute = "z", range = [-1, 2.5]}
[set]
cull = "back"
[axes]
tile = {from = 8, to = 64, times = 2}
binning = ["exact", "queue"]
capacity = {from = 16, to = 100, step = 40}
[kernels]
shade = ["", "mine.comp"]
[[leave-out]]
tile = [8, 16]
"kernel:shade" = "mine.comp"
[[also]]
binning = "bitmask"
[reference]
tile = 32
binning = "queue"
[truth]
sub-pixel = 8
[plot]
curve = ["binning", "kernel:shade", "scene"]
against = ["tile", "size"]
heat = [["tile", "binning"]]
[quick]
sizes = [16]
rounds = 1
scenes = ["z-first"]
[[expect]]
where = {binning = "bitmask", tile = [8, 16]}
scene = ["z-first", "values"]
status = ["ok", "overflow"]
error.id_mismatch = 0
truth_error.depth_max_abs = "<= 1e-3"
counters.pieces = "> 0"
)";
  // A dotted key is a table of its own, not a name.
  CHECK(mistake(desk, text).starts_with(":13:3: a scene has no key 'b'"));
  std::string good = text;
  good.replace(good.find("a.b ="), 5, "\"a.b\" =");
  const Sweep sweep = read(desk, good);
  CHECK(sweep.sha256.size() == 64);
  REQUIRE(sweep.scenes.size() == 3);
  CHECK(sweep.scenes[0].name == "z-first");
  CHECK(sweep.scenes[0].text == "two.obj");
  CHECK(sweep.scenes[0].input == (desk.path() / "two.obj").string());
  CHECK(sweep.scenes[1].name == "a.b");
  CHECK(sweep.scenes[1].input == "generate:fan");
  CHECK_FALSE(sweep.scenes[1].x);
  CHECK(sweep.scenes[2].x == 2);
  CHECK(sweep.scenes[2].attribute.name == "z");
  CHECK(sweep.scenes[2].attribute.range->most == 2.5f);
  CHECK(sweep.sizes == std::vector<Size>{{64, 64}, {32, 16}});
  CHECK(sweep.devices == std::vector<std::string>{"cpu", "vulkan:llvmpipe"});
  CHECK(sweep.threads == std::vector<unsigned>{2, 1});
  CHECK((sweep.rounds == 3 && sweep.warmUp == 0 && sweep.repeats == 2 && sweep.timeLimitS == 0.5 && sweep.seed == 7));
  CHECK(sweep.set.text() == "cull=back");
  const auto swept = sweptAxes(sweep);
  REQUIRE(swept.size() == 4);
  CHECK((swept[0].axis == "tile" && swept[0].values == std::vector<std::string>{"8", "16", "32", "64"}));
  CHECK((swept[1].axis == "binning" && swept[1].values == std::vector<std::string>{"exact", "queue", "bitmask"}));
  CHECK((swept[2].axis == "capacity" && swept[2].values == std::vector<std::string>{"16", "56", "96"}));
  CHECK((swept[3].axis == "kernel:shade" && swept[3].values == std::vector<std::string>{"", "mine.comp"}));
  CHECK(sweep.kernels[0].files[1] == desk.path() / "mine.comp");
  CHECK(sweep.reference.text() == "binning=queue tile=32");
  CHECK(sweep.truth.text() == "sub-pixel=8");
  CHECK_FALSE(sweep.quick);
  const Sweep quick = read(desk, good, true);
  CHECK(quick.quick);
  CHECK(quick.sizes == std::vector<Size>{{16, 16}});
  CHECK((quick.rounds == 1 && quick.repeats == 2 && quick.scenes.size() == 1));
  CHECK(quick.sha256 == sweep.sha256);
}

TEST_CASE("Every sweep of the experiments can be read") {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(TESSERA_SOURCE_DIR "/experiments")) {
    const auto path = entry.path() / "sweep.toml";
    if (!std::filesystem::exists(path)) continue;
    INFO(path);
    CHECK(readSweep(path).scenes.size() > 0);
    CHECK(readSweep(path, true).scenes.size() > 0);
    ++count;
  }
  CHECK(count >= 9);
}
