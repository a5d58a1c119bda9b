// Tolerances of compare, as a library and as a command.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "command.h"
#include "host/images/comparison.h"
#include "host/support/files.h"
#include "tests/support/streams.h"

using namespace tessera;
using namespace tessera::test;
using Catch::Matchers::Contains;

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInfinity = std::numeric_limits<float>::infinity();

Framebuffer grey(std::uint32_t extent) {
  Framebuffer frame{.width = extent, .height = extent, .depth = {}, .ids = {}, .hits = {}, .colour = {}};
  frame.ids.assign(frame.pixels(), 1);
  frame.depth.assign(frame.pixels(), 0.5f);
  frame.colour.assign(frame.pixels(), glm::vec3(0.5f));
  return frame;
}

Difference compare(const Framebuffer& a, const Framebuffer& b, const images::Tolerances& tolerances) {
  images::Comparison comparison(tolerances);
  comparison.add(a, b);
  return comparison.difference();
}

}  // namespace

TEST_CASE("a tolerance is an amount or float32 steps and each counts what is beyond it") {
  const Framebuffer a = grey(4);
  Framebuffer b = a;
  b.depth[0] = std::nextafter(0.5f, 1.0f);
  b.depth[1] = 0.5f + 0x1p-10f;
  CHECK(compare(a, b, {}).depth == 2);
  CHECK(compare(a, b, images::Tolerances{.depth = {0, 1}, .attribute = {}, .colour = {}}).depth == 1);
  CHECK(compare(a, b, images::Tolerances{.depth = {0x1p-24, 0}, .attribute = {}, .colour = {}}).depth == 1);
  CHECK(compare(a, b, images::Tolerances{.depth = {0x1p-10, 0}, .attribute = {}, .colour = {}}).equal());
  CHECK(compare(a, b, images::Tolerances{.depth = {0x1p-10, 0}, .attribute = {}, .colour = {}}).depthMaxAbs ==
        0x1p-10);  // it says how far they are apart
  CHECK(compare(a, b, images::Tolerances{.depth = {}, .attribute = {}, .colour = {1, 0}}).depth == 2);
  b = a;
  b.colour[3].z = 0.75f;
  CHECK(compare(a, b, images::Tolerances{.depth = {}, .attribute = {}, .colour = {0.25, 0}}).colour == 0);
  CHECK(compare(a, b, images::Tolerances{.depth = {}, .attribute = {}, .colour = {0.2, 0}}).colour == 1);
  CHECK(compare(a, b, {}).colourMax == 0.25);
}

TEST_CASE("no tolerance takes a number for what is none") {
  Framebuffer a = grey(2), b = a;
  valuesOf(a) = {kNan, kNan, kInfinity, std::numeric_limits<float>::max()};
  valuesOf(b) = {kNan, 0, std::numeric_limits<float>::max(), -kInfinity};
  CHECK(compare(a, b, images::Tolerances{.depth = {}, .attribute = {1e300, 1e9}, .colour = {}}).attribute == 3);
  valuesOf(b)[0] = -kNan;
  CHECK(compare(a, b, {}).attribute == 4);
  CHECK(compare(a, b, images::Tolerances{.depth = {}, .attribute = {0, 1}, .colour = {}}).attribute == 3);
}

TEST_CASE("rows that come one after the other make the whole") {
  Framebuffer a = grey(4), b = a;
  b.ids[6] = 2;
  b.ids[9] = kNoTriangle;
  const Difference whole = compare(a, b, {});
  images::Comparison rows;
  for (std::size_t y = 0; y < 4; ++y) {
    const auto row = [&](const Framebuffer& frame) {
      Framebuffer one = grey(4);
      one.height = 1;
      one.ids.assign(&frame.ids[4 * y], &frame.ids[4 * y] + 4);
      one.depth.resize(4);
      one.colour.resize(4);
      return one;
    };
    rows.add(row(a), row(b));
  }
  CHECK(rows.difference().pixels == 16);
  CHECK(rows.difference().id == whole.id);
  CHECK(rows.difference().coverage == 1);
  CHECK(rows.difference().anywhere == 2);
  CHECK(rows.difference().firstX == 2);
  CHECK(rows.difference().firstY == 1);
  CHECK(rows.firstOfB().ids == std::vector<std::uint32_t>{2});
}

TEST_CASE("compare takes tolerances and a share of the pixels and says what is beyond them") {
  const support::TemporaryFolder folder(support::temporaryRoot(), "tessera-tolerance-test");
  Framebuffer a = grey(20), b = a;
  for (std::size_t k = 0; k < 40; ++k) b.colour[k].x += 0.001f;
  b.colour[399].y = 0.75f;
  b.depth[7] = std::nextafter(0.5f, 1.0f);
  writeImage(folder.path() / "a.exr", a);
  writeImage(folder.path() / "b.exr", b);
  const auto compared = [&](const std::string& options) {
    return test::run(folder.path(), "'" TESSERA_PROGRAM "' compare a.exr b.exr " + options);
  };
  const std::string near = "--tolerance colour=0.002 --tolerance depth=1ulp ";
  CHECK(compared("").code == 5);
  CHECK(compared(near).code == 5);
  CHECK(compared(near + "--allow 1").code == 0);
  CHECK(compared(near + "--allow 0").code == 5);
  CHECK(compared(near + "--allow 0.25%").code == 0);
  CHECK(compared(near + "--allow 0.2%").code == 5);
  CHECK(compared("--allow 41").code == 0);
  CHECK(compared("--allow 40").code == 5);
  CHECK(compared(near + "--allow 1 --at-most colour=0.3").code == 0);
  CHECK(compared(near + "--allow 1 --at-most colour=0.2").code == 5);
  CHECK(compared(near + "--allow 1 --at-most colour=0").code == 5);
  CHECK(compared("--tolerance colour=1 --tolerance depth=1").code == 0);
  const auto said = compared(near + "--allow 1");
  CHECK_THAT(said.text, Contains("equal within the tolerances") && Contains("beyond tolerance") && Contains(" 41") &&
                            Contains("1 of 400 pixels differ beyond the tolerances; 1 may") && Contains(" -"));
  for (const char* const wrong :
       {"--tolerance depth", "--tolerance hits=1", "--tolerance depth=-1", "--tolerance depth=x",
        "--tolerance depth=nan", "--allow x", "--allow -1", "--at-most colour=", "--max-unpacked many"}) {
    const auto refused = compared(wrong);
    INFO(wrong << "\n" << refused.text);
    CHECK(refused.code == 2);
    CHECK(std::count(refused.text.begin(), refused.text.end(), '\n') == 1);
  }
  CHECK(compared("--max-unpacked 1K").code == 2);
  CHECK(compared("--max-unpacked 1M").code == 5);

  CHECK(compared(near + "--json row.jsonl").code == 5);
  const auto stdoutAlone = compared(near + "--json - 2>/dev/null");
  const auto row = nlohmann::json::parse(stdoutAlone.text);
  CHECK(row["verdict"] == "different");
  CHECK(row["exit_code"] == 5);
  CHECK(row["bits"]["colour_mismatch"] == 41);
  CHECK(row["bits"]["id_mismatch"] == 0);
  CHECK(row["bits"]["hit_count_mismatch"].is_null());
  CHECK(row["bits"]["attribute_mismatch"].is_null());
  CHECK(row["beyond_tolerance"]["colour_mismatch"] == 1);
  CHECK(row["beyond_tolerance"]["first"] == nlohmann::json::array({19, 19}));
  CHECK(row["beyond_limit"].is_null());
}
