// Differences of two framebuffers, in numbers and as a picture.
#include <tessera/error.h>
#include <tessera/image.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "tests/support/streams.h"

using namespace tessera;
using namespace tessera::test;

namespace {

// 3 x 2, pixels 0 to 4 drawn and pixel 5 empty.
Framebuffer small() {
  Framebuffer frame{.width = 3, .height = 2, .depth = {}, .ids = {}, .hits = {}, .colour = {}};
  frame.ids = {0, 1, 2, 3, 4, kNoTriangle};
  frame.depth = {0.25f, 0.25f, 0.5f, 0.5f, 0.75f, 1.0f};
  return frame;
}

}  // namespace

TEST_CASE("equal frames differ nowhere") {
  Framebuffer frame = small();
  frame.hits.assign(6, 1);
  frame.colour.assign(6, glm::vec3(0.5f));
  const Difference d = compare(frame, frame);
  CHECK(d.equal());
  CHECK(d.pixels == 6);
  CHECK(d.coverage == 0);
  CHECK(d.firstX == -1);
  CHECK(d.firstY == -1);
  CHECK(d.depthMaxAbs == 0);
  CHECK(d.depthMaxUlp == 0);
  CHECK(d.psnr == std::numeric_limits<double>::infinity());
}

TEST_CASE("each kind of difference is counted by itself") {
  const Framebuffer a = small();
  Framebuffer b = small();
  b.depth[1] = std::nextafter(std::nextafter(b.depth[1], 1.0f), 1.0f);  // two steps
  b.ids[3] = 9;
  b.ids[4] = kNoTriangle;  // coverage; its depth of 1.0 is no depth error
  b.depth[4] = 1.0f;
  const Difference d = compare(a, b);
  CHECK_FALSE(d.equal());
  CHECK(d.coverage == 1);
  CHECK(d.id == 2);
  CHECK(d.depth == 2);
  CHECK_FALSE(d.hits);  // absent, since neither has any
  CHECK_FALSE(d.attribute);
  CHECK_FALSE(d.colour);
  CHECK(d.depthMaxUlp == 2);
  CHECK(d.depthMaxAbs == 0x1p-24);
  CHECK(d.firstX == 1);
  CHECK(d.firstY == 0);
  CHECK_FALSE(d.psnr);
}

TEST_CASE("depth is compared by bits and signed zeros are 0 steps apart") {
  Framebuffer a = small(), b = small();
  a.depth[0] = 0.0f;
  b.depth[0] = -0.0f;
  CHECK(compare(a, b).depth == 1);
  CHECK(compare(a, b).depthMaxUlp == 0);
  b.depth[0] = std::numeric_limits<float>::quiet_NaN();
  CHECK(compare(a, b).depth == 1);
  CHECK(compare(a, b).depthMaxAbs == std::numeric_limits<double>::infinity());
}

TEST_CASE("the first differing pixel is the first in row order") {
  Framebuffer b = small();
  b.ids[4] = 8;
  b.ids[5] = 8;
  CHECK(compare(small(), b).firstX == 1);
  CHECK(compare(small(), b).firstY == 1);
  CHECK(compare(small(), b).coverage == 1);
}

TEST_CASE("hits and colour are compared where both frames have them") {
  Framebuffer a = small(), b = small();
  a.hits = {1, 1, 1, 1, 1, 0};
  CHECK(compare(a, b).equal());
  b.hits = {1, 2, 1, 1, 1, 1};
  CHECK(compare(a, b).hits == 2);
  CHECK(compare(a, b).firstX == 1);
  a.ids.clear();
  a.depth.clear();  // as under commit=count: coverage is then what the hits say
  CHECK(compare(a, b).coverage == 1);
  CHECK_FALSE(compare(a, b).id);
  CHECK_FALSE(compare(a, b).depth);
  CHECK_FALSE(compare(a, b).depthMaxAbs);

  a = b = small();
  a.colour.assign(6, glm::vec3(0.5f));
  b.colour = a.colour;
  b.colour[2].y = 0.75f;  // mean square 1/16 / 18
  const Difference d = compare(a, b);
  CHECK(d.colour == 1);
  CHECK(d.psnr.value() == Approx(10 * std::log10(16.0 * 18)));
  CHECK_FALSE(d.equal());
}

TEST_CASE("values are compared by bits and their error is of the pixels that have one in both") {
  const float none = std::numeric_limits<float>::quiet_NaN();
  Framebuffer a = small(), b = small();
  valuesOf(a) = {1, 2, 3, none, none, 0.0f};
  valuesOf(b) = {1, 2.5f, 2, none, 7, -0.0f};
  const Difference d = compare(a, b);
  CHECK(d.attribute == 4);  // one has a value on one side alone, one another sign of zero
  CHECK(d.attributeMax == 1);
  CHECK(d.attributeRms.value() == Approx(std::sqrt((0.25 + 1) / 4)));
  CHECK(d.firstX == 1);
  CHECK_FALSE(d.equal());
  CHECK(differencePicture(a, b)[1] != differencePicture(a, b)[0]);
  valuesOf(b) = valuesOf(a);
  CHECK(compare(a, b).equal());
}

TEST_CASE("an unknown id is covered and agrees with any other") {
  Framebuffer a = small(), b = small();
  b.ids = {kUnknownTriangle, kUnknownTriangle, kUnknownTriangle, kUnknownTriangle, kNoTriangle, kUnknownTriangle};
  const Difference d = compare(a, b);
  CHECK(d.coverage == 2);
  CHECK_FALSE(d.id);  // the ids were not compared
  CHECK_FALSE(d.equal());
  CHECK(d.firstX == 1);
  CHECK(d.firstY == 1);
  CHECK(compare(b, a).coverage == 2);
  b.ids[4] = kUnknownTriangle;
  b.ids[5] = kNoTriangle;
  CHECK(compare(a, b).equal());
  CHECK(compare(a, b).coverage == 0);
  CHECK_FALSE(compare(a, b).id);
}

TEST_CASE("of frames with depths alone nothing is said about coverage") {
  Framebuffer a = small(), b = small();
  a.ids.clear();
  b.depth[2] = 0.75f;
  const Difference d = compare(a, b);
  CHECK_FALSE(d.coverage);
  CHECK_FALSE(d.id);
  CHECK(d.depth == 1);
  CHECK(d.firstX == 2);
}

TEST_CASE("frames that cannot be compared are refused") {
  Framebuffer other = small();
  other.width = 2;
  other.height = 3;
  CHECK_THROWS_WITH(compare(small(), other), Catch::Contains("3 x 2 and 2 x 3"));
  CHECK_THROWS_WITH(differencePicture(small(), other), Catch::Contains("3 x 2 and 2 x 3"));
  Framebuffer counts{
      .width = 3, .height = 2, .depth = {}, .ids = {}, .hits = std::vector<std::uint32_t>(6, 1), .colour = {}};
  CHECK_THROWS_WITH(compare(small(), counts), Catch::Contains("no channel in common"));
}

TEST_CASE("the picture has one colour for each kind of difference and greys where both agree") {
  Framebuffer a = small(), b = small();
  b.depth[1] = 0.3f;
  b.ids[2] = 9;
  b.ids[3] = kNoTriangle;
  a.hits.assign(6, 1);
  b.hits = {1, 1, 1, 1, 2, 1};
  const auto p = differencePicture(a, b);
  REQUIRE(p.size() == 6);
  const auto grey = [](const glm::vec3& c) { return c.x == c.y && c.y == c.z; };
  CHECK(grey(p[0]));
  CHECK(grey(p[5]));
  CHECK(p[5].x > p[0].x);
  for (std::size_t i = 1; i < 5; ++i) {
    CHECK_FALSE(grey(p[i]));
    for (std::size_t k = 1; k < i; ++k) CHECK(p[i] != p[k]);
  }
}
