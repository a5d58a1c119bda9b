#include <tessera/error.h>
#include <tessera/input.h>

#include <algorithm>
#include <catch2/catch.hpp>

#include "evidence-scenes.h"
#include "tests/support/compare.h"
#include "tests/support/machines.h"

namespace tessera::test {
namespace {

const Evidence kEvidence{
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
    {"sub-pixel",
     {{"0",
       [] {
         for (const int x : corners({{"sub-pixel", "0"}})) CHECK((x - 128) % 256 == 0);
       }},
      {"4", [] { CHECK(finestBit(corners({{"sub-pixel", "4"}})) == 16); }},
      {"6", [] { CHECK(finestBit(corners({{"sub-pixel", "6"}})) == 4); }},
      {"8", [] { CHECK(finestBit(corners({{"sub-pixel", "8"}})) == 1); }}}},
    {"fill",
     // A square of two triangles whose corners are samples: 11 x 11 samples lie in it or on its outline.
     {{"top-left",
       [] {
         const auto hits = on(sampleSquare(), {{"fill", "top-left"}, {"commit", "count"}}).image.hits;
         CHECK(std::ranges::count(hits, 1u) == 100);
         CHECK(std::ranges::count(hits, 0u) == 1024 - 100);
       }},
      {"inclusive",
       [] {
         const auto hits = on(sampleSquare(), {{"fill", "inclusive"}, {"commit", "count"}}).image.hits;
         CHECK(std::ranges::count(hits, 2u) == 11);  // the diagonal
         CHECK(std::ranges::count(hits, 1u) == 110);
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
    {"compact",
     {{"on",
       [] {
         // Each tile goes through all slots: no more of them than pieces are left.
         const auto back = [](const char* compact) {
           return on(sphere(), {{"cull", "back"}, {"binning", "aabb-scan"}, {"compact", compact}, {"counters", "work"}});
         };
         const Frame on_ = back("on"), off = back("off");
         CHECK(count(on_, "visited") * on_.counters.at("submitted") == count(off, "visited") * count(on_, "pieces"));
         CHECK(on_.image.ids == off.image.ids);
       }},
      {"off",
       [] {
         const Frame frame = on(sphere(), {{"cull", "back"}, {"compact", "off"}, {"binning", "aabb-scan"}, {"counters", "work"}});
         CHECK(count(frame, "visited") % frame.counters.at("submitted") == 0);
       }}}},
    {"binning",
     {{"none",
       [] {
         CHECK(ran(on(sphere(), {{"binning", "none"}}), "raster-items"));
       }},
      {"aabb-scan",
       [] {
         const Frame frame = on(sphere(), {{"binning", "aabb-scan"}, {"tile", "64"}});
         CHECK(!ran(frame, "bin-insert"));
         CHECK(count(frame, "visited") == 25 * count(frame, "submitted"));  // each of 5 x 5 tiles sees them all
       }},
      {"bitmask",
       [] {
         const Frame frame = on(sphere(), {{"binning", "bitmask"}});
         CHECK(ran(frame, "bin-insert"));
         CHECK(!ran(frame, "scan-blocks"));
         CHECK(count(frame, "visited") == count(on(sphere(), {{"binning", "exact"}}), "binned"));
         CHECK(count(frame, "binned") == 0);
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
    {"tile-test",
     {{"edges",
       [] {
         CHECK(count(on(crossing(), {{"tile-test", "edges"}, {"tile", "8"}}), "binned") <
               count(on(crossing(), {{"tile-test", "box"}, {"tile", "8"}}), "binned"));
       }},
      {"box",
       [] {
         Scene diagonal;  // its box is 128 x 128, all tiles of which it goes to
         diagonal.width = diagonal.height = 128;
         diagonal.clip = {{-1, -1, 0.5f, 1}, {1, 1, 0.5f, 1}, {0.98f, 1, 0.5f, 1}};
         diagonal.triangles = {{0, 1, 2}};
         CHECK(count(on(diagonal, {{"tile-test", "box"}, {"tile", "8"}}), "binned") == 256);
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
};

}  // namespace

const std::function<void()>& evidence(const std::string& axis, const std::string& value) {
  INFO(axis << "=" << value << " needs an entry in evidence.cpp or evidence-raster.cpp");
  const Evidence& of = kEvidence.contains(axis) ? kEvidence : rasterEvidence();
  REQUIRE(of.contains(axis));
  REQUIRE(of.at(axis).contains(value));
  return of.at(axis).at(value);
}

}  // namespace tessera::test
