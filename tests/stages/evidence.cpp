#include "evidence.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "datasets/input.h"
#include "host/error.h"
#include "tests/support/compare.h"
#include "tests/support/machines.h"

namespace tessera {
namespace {

/// The sphere fills 300 x 300 pixels; some of its triangles lie between samples.
Scene sphere() { return loadInput("generate:icosphere?level=5", 300, 300); }
/// A large triangle with w from 1 to 4, reaching behind the near plane.
Scene crossing() {
  Scene scene;
  scene.width = scene.height = 128;
  scene.clip = {{-1, -1, 0.5f, 1}, {4, -4, 2, 4}, {0, 2, -0.5f, 2}};
  scene.triangles = {{0, 1, 2}};
  return scene;
}

Frame on(const Scene& scene, const Variant& variant) {
  return machineAt<Cpu>()->render(scene, variant, {.countWork = variant.get("counters") == ""});
}
std::uint64_t count(const Frame& frame, const char* counter) { return frame.counters.at(counter); }
bool ran(const Frame& frame, const std::string& stage) {
  return std::ranges::any_of(frame.times.stages, [&](const auto& s) { return s.first == stage; });
}
std::string refusal(const Scene& scene, const Variant& variant, ExitCode code) {
  try {
    on(scene, variant);
  } catch (const Error& error) {
    CHECK(error.code() == code);
    return error.what();
  }
  return "";
}

const std::map<std::string, std::map<std::string, std::function<void()>>> kEvidence{
    {"route",
     {{"cpp", [] { CHECK(machineAt<Cpu>()->render(sphere()).plan.resolved.get("route") == "cpp"); }},
      {"spirv",
       [] {
         if (Machine* m = machineAt<VulkanSpirv>()) CHECK(m->render(sphere()).plan.resolved.get("route") == "spirv");
       }},
      {"glsl",
       [] {
         if (Machine* m = machineAt<VulkanGlsl>()) CHECK(m->render(sphere()).plan.resolved.get("route") == "glsl");
       }}}},
    {"plan",
     {{"planned",
       [] {
         CHECK(!ran(on(sphere(), {{"plan", "planned"}}), "clear"));
       }},
      {"full",
       [] {
         CHECK(ran(on(sphere(), {{"plan", "full"}}), "clear"));
       }}}},
    {"clip",
     {{"on",
       [] {
         CHECK(count(on(crossing(), {{"clip", "on"}}), "clipped") == 1);
       }},
      {"off",
       [] {
         CHECK(refusal(crossing(), {{"clip", "off"}}, ExitCode::kUsage) != "");
       }}}},
    {"projection",
     {{"perspective",
       [] {
         // (1, 1, ., 2) is half way to the corner.
         Scene scene;
         scene.width = scene.height = 128;
         scene.clip = {{-1, -1, 0.5f, 1}, {1, -1, 1, 2}, {-1, 1, 1, 2}};
         scene.triangles = {{0, 1, 2}};
         const Frame frame = on(scene, {{"projection", "perspective"}});
         CHECK(frame.image.ids[32 * 128 + 32] == 0);
         CHECK(frame.image.ids[10 * 128 + 100] == kNoTriangle);
       }},
      {"orthographic",
       [] {
         CHECK(refusal(crossing(), {{"projection", "orthographic"}}, ExitCode::kUsage) != "");
       }}}},
    {"cull",
     {{"none",
       [] {
         CHECK(count(on(sphere(), {{"cull", "none"}}), "facing") == 0);
       }},
      {"back",
       [] {
         const Frame frame = on(sphere(), {{"cull", "back"}});
         CHECK(count(frame, "facing") > 1000);
         CHECK(frame.image.ids == on(sphere(), {}).image.ids);  // of a closed surface the front is in sight
       }},
      {"front",
       [] {
         const Frame frame = on(sphere(), {{"cull", "front"}});
         CHECK(count(frame, "facing") > 1000);
         CHECK(frame.image.ids != on(sphere(), {}).image.ids);
       }}}},
    {"between-samples",
     {{"on",
       [] {
         CHECK(count(on(sphere(), {{"between-samples", "on"}}), "betweenSamples") > 0);
       }},
      {"off",
       [] {
         const Frame off = on(sphere(), {{"between-samples", "off"}}), on_ = on(sphere(), {{"between-samples", "on"}});
         CHECK(count(off, "betweenSamples") == 0);
         CHECK(count(off, "pieces") == count(on_, "pieces") + count(on_, "betweenSamples"));
       }}}},
    {"binning",
     {{"none",
       [] {
         CHECK(ran(on(sphere(), {{"binning", "none"}}), "raster-items"));
       }},
      {"queue",
       [] {
         const Frame frame = on(sphere(), {{"binning", "queue"}, {"capacity", "65536"}});
         CHECK(ran(frame, "bin-insert"));
         CHECK(!ran(frame, "scan-blocks"));
         CHECK(count(frame, "binned") == count(on(sphere(), {{"binning", "exact"}}), "binned"));
       }},
      {"exact",
       [] {
         const Frame frame = on(sphere(), {{"binning", "exact"}});
         CHECK(ran(frame, "bin-count"));
         CHECK(ran(frame, "scan-blocks"));
         CHECK(count(frame, "binned") >= count(frame, "pieces"));
       }}}},
    {"tile",
     {{"8",
       [] {
         CHECK(count(on(sphere(), {{"tile", "8"}}), "binned") > count(on(sphere(), {{"tile", "16"}}), "binned"));
       }},
      {"16",
       [] {
         CHECK(count(on(sphere(), {{"tile", "16"}}), "binned") > count(on(sphere(), {{"tile", "32"}}), "binned"));
       }},
      {"32",
       [] {
         CHECK(count(on(sphere(), {{"tile", "32"}}), "binned") > count(on(sphere(), {{"tile", "64"}}), "binned"));
       }},
      {"64",
       [] {
         CHECK(count(on(sphere(), {{"tile", "64"}}), "largestBin") >
               count(on(sphere(), {{"tile", "32"}}), "largestBin"));
       }}}},
    {"capacity",
     {{"least",
       [] {
         CHECK(count(on(sphere(), {{"binning", "queue"}, {"capacity", "16"}}), "retries") == 1);
       }},
      {"most",
       [] {
         CHECK(count(on(sphere(), {{"binning", "queue"}, {"capacity", "65536"}}), "retries") == 0);
       }}}},
    {"overflow",
     {{"retry",
       [] {
         const Frame frame = on(sphere(), {{"binning", "queue"}, {"capacity", "16"}, {"overflow", "retry"}});
         CHECK(count(frame, "retries") == 1);
         CHECK(count(frame, "overflowed") == 0);
         CHECK(frame.image.ids == on(sphere(), {}).image.ids);
       }},
      {"error",
       [] {
         CHECK_THAT(
             refusal(sphere(), {{"binning", "queue"}, {"capacity", "16"}, {"overflow", "error"}}, ExitCode::kOverflow),
             Catch::Contains("capacity=16") && Catch::Contains("did not fit") && Catch::Contains("overflow=retry"));
         CHECK(refusal(sphere(), {{"binning", "queue"}, {"capacity", "65536"}, {"overflow", "error"}},
                       ExitCode::kOverflow) == "");
       }},
      {"drop",
       [] {
         const Frame frame = on(sphere(), {{"binning", "queue"}, {"capacity", "16"}, {"overflow", "drop"}});
         CHECK(count(frame, "retries") == 0);
         CHECK(count(frame, "overflowed") > 0);
         CHECK(frame.image.ids != on(sphere(), {}).image.ids);
         CHECK(count(frame, "overflowed") + count(frame, "binned") ==
               count(on(sphere(), {{"binning", "exact"}}), "binned"));
       }}}},
    {"commit",
     {{"tile-owned",
       [] {
         CHECK(count(on(sphere(), {{"commit", "tile-owned"}}), "atomics") == 0);
       }},
      {"depth32+id32",
       [] {
         const Frame frame = on(sphere(), {{"commit", "depth32+id32"}});
         CHECK(count(frame, "atomics") == count(frame, "covered"));
         CHECK(ran(frame, "resolve"));
       }},
      {"two-pass",
       [] {
         // One for each sample in the depth pass, and one for each that is in sight in the id pass.
         const Frame frame = on(sphere(), {{"commit", "two-pass"}});
         CHECK(count(frame, "atomics") > count(frame, "covered"));
         CHECK(count(frame, "atomics") < 2 * count(frame, "covered"));
         CHECK(!ran(frame, "resolve"));
       }},
      {"count",
       [] {
         const Frame frame = on(sphere(), {{"commit", "count"}});
         CHECK(frame.image.ids.empty());
         CHECK(frame.image.hits == reference::render(sphere()).image.hits);
       }}}},
    {"traversal",
     {{"pixel",
       [] {
         CHECK(count(on(sphere(), {{"traversal", "pixel"}}), "tests") > 2 * count(on(sphere(), {}), "covered"));
       }},
      {"cell-reject",
       [] {
         CHECK(count(on(sphere(), {{"traversal", "cell-reject"}}), "tests") <
               count(on(sphere(), {{"traversal", "pixel"}}), "tests"));
       }}}},
    {"edge",
     // 32 bits hold a triangle up to 30,000 / 256 pixels; both images are right on either side of it, and so are those
     // beyond.
     {{"int32",
       [] {
         for (const float side : {100.0f, 30000.0f / 256, 30001.0f / 256, 500.0f}) {
           Scene scene;
           scene.width = scene.height = 512;
           for (const auto& [x, y] : {std::pair{3.0f, 5.0f}, {3.0f + side, 7.0f}, {9.0f, 5.0f + side}})
             scene.clip.emplace_back(x / 256 - 1, y / 256 - 1, 0.5f, 1.0f);
           scene.triangles = {{0, 1, 2}};
           CHECK(difference(on(scene, {{"edge", "int32"}}), reference::render(scene)) == "");
         }
       }},
      {"int64",
       [] {
         CHECK(difference(on(sphere(), {{"edge", "int64"}}), reference::render(sphere())) == "");
       }}}},
    {"counters",
     {{"basic",
       [] {
         CHECK(count(on(sphere(), {{"counters", "basic"}}), "tests") == 0);
       }},
      {"work",
       [] {
         const Frame frame = on(sphere(), {{"counters", "work"}});
         CHECK(count(frame, "tests") > 0);
         CHECK(count(frame, "covered") == reference::render(sphere()).counts.covered);
       }}}},
    {"shade",
     {{"none",
       [] {
         CHECK(on(sphere(), {{"shade", "none"}}).image.colour.empty());
       }},
      {"id",
       [] {
         CHECK(on(sphere(), {{"shade", "id"}}).image.colour != on(sphere(), {{"shade", "flat"}}).image.colour);
       }},
      {"flat",
       [] {
         CHECK(on(sphere(), {{"shade", "flat"}}).image.colour != on(sphere(), {{"shade", "smooth"}}).image.colour);
       }},
      {"smooth",
       [] {
         CHECK(on(sphere(), {{"shade", "smooth"}}).image.colour.size() == 300 * 300);
       }}}},
};

}  // namespace

const std::function<void()>& evidence(const std::string& axis, const std::string& value) {
  INFO(axis << "=" << value << " needs an entry in kEvidence of evidence.cpp");
  REQUIRE(kEvidence.contains(axis));
  REQUIRE(kEvidence.at(axis).contains(value));
  return kEvidence.at(axis).at(value);
}

}  // namespace tessera
