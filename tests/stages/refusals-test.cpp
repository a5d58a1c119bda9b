// Variants that a scene or a device cannot have: the exit code of its kind, and a line that says which axis and value,
// why, and what would do.
#include <tessera/error.h>
#include <tessera/input.h>
#include <tessera/plan.h>

#include <catch2/catch.hpp>

#include "host/plan/choice.h"
#include "tests/support/streams.h"

using namespace tessera;
using namespace tessera::test;

namespace {

DeviceInfo cpu() {
  DeviceInfo info;
  info.routes = {"cpp"};
  info.name = "test processor";
  return info;
}
DeviceInfo vulkan() {
  DeviceInfo info;
  info.routes = {"spirv", "glsl"};
  info.name = "test GPU";
  return info;
}

void checkRefusal(const Scene& scene, const Variant& variant, const DeviceInfo& device, ExitCode code,
                  const std::vector<std::string>& parts) {
  INFO(variant.text());
  try {
    makePlan(scene, variant, device);
    FAIL("accepted");
  } catch (const Error& error) {
    const std::string line = error.what();
    CHECK(error.code() == code);
    CHECK(line.find('\n') == std::string::npos);
    for (const std::string& part : parts) CHECK_THAT(line, Catch::Contains(part));
  }
}

Scene sphere() { return loadInput("generate:icosphere?level=1", 64, 64); }

}  // namespace

TEST_CASE("Axes that a scene cannot have are refused", "[refusals]") {
  Scene crossing = sphere();
  crossing.clipFromObject[11] -= 3;  // z: the near side comes before the near plane
  checkRefusal(crossing, {{"clip", "off"}}, cpu(), ExitCode::kUsage, {"clip=off", "cross a clip plane", "set clip=on"});
  checkRefusal(sphere(), {{"projection", "orthographic"}}, cpu(), ExitCode::kUsage,
               {"projection=orthographic", "w is not 1", "leave projection unset"});

  Scene clipSpace;
  clipSpace.clip = {{0, 0, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}};
  clipSpace.triangles = {{0, 1, 2}};
  for (const char* shade : {"flat", "smooth"})
    checkRefusal(clipSpace, {{"shade", shade}}, cpu(), ExitCode::kUsage,
                 {std::string("shade=") + shade, "clip-space positions only", "set shade=id"});
  Scene bare = sphere();
  dropNormals(bare);
  checkRefusal(bare, {{"shade", "smooth"}}, cpu(), ExitCode::kUsage,
               {"shade=smooth", "no vertex normals", "set shade=flat"});
}

TEST_CASE("Axes that do not go together are refused", "[refusals]") {
  checkRefusal(sphere(), {{"commit", "tile-owned"}, {"binning", "none"}}, cpu(), ExitCode::kUsage,
               {"commit=tile-owned", "binning=none", "owns tiles", "set binning=aabb-scan or queue or exact"});
  checkRefusal(sphere(), {{"shade", "flat"}, {"commit", "count"}}, cpu(), ExitCode::kUsage,
               {"shade=flat", "commit=count", "no ids", "set shade=none"});
  checkRefusal(sphere(), {{"commit", "depth24+lum8"}, {"shade", "smooth"}}, cpu(), ExitCode::kUsage,
               {"commit=depth24+lum8", "shade=smooth", "one colour a triangle", "set shade=id or flat"});
  checkRefusal(sphere(), {{"capacity", "64"}, {"binning", "exact"}}, cpu(), ExitCode::kUsage,
               {"capacity=64", "binning=exact", "only queues have a capacity", "set binning=queue"});
  checkRefusal(sphere(), {{"overflow", "drop"}, {"binning", "bitmask"}}, cpu(), ExitCode::kUsage,
               {"overflow=drop", "binning=bitmask", "only queues overflow", "set binning=queue"});
  checkRefusal(sphere(), {{"tile", "8"}, {"binning", "none"}}, cpu(), ExitCode::kUsage,
               {"tile=8", "binning=none", "there are no tiles", "set binning="});
  for (const char* const edge : {"float32-plane", "float32-difference"}) {
    checkRefusal(sphere(), {{"edge", edge}, {"tile-test", "edges"}}, cpu(), ExitCode::kUsage,
                 {"tile-test=edges", edge, "may cover samples", "set edge=int32 or int64 or float64"});
    checkRefusal(sphere(), {{"edge", edge}, {"step", "incremental"}}, cpu(), ExitCode::kUsage,
                 {"step=incremental", edge, "round again", "set edge=int32 or int64 or float64"});
    // Left to the plan, tiles are tested by their boxes.
    CHECK(makePlan(sphere(), {{"edge", edge}}, cpu()).resolved.get("tile-test") == "box");
  }
  // What one axis asks for decides another that is left to the plan.
  CHECK(makePlan(sphere(), {{"capacity", "64"}}, cpu()).resolved.get("binning") == "queue");
  CHECK(makePlan(sphere(), {{"commit", "lock"}, {"tile", "8"}}, cpu()).resolved.get("binning") == "exact");
  CHECK(makePlan(sphere(), {{"commit", "depth32+rgba8"}}, cpu()).resolved.get("shade") == "flat");
}

TEST_CASE("What a scene makes hopeless is refused before anything runs", "[refusals]") {
  Scene million;
  million.width = million.height = 2048;
  million.clip = {{0, 0, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}};
  million.triangles.assign(1310720, {0, 1, 2});
  checkRefusal(million, {{"binning", "aabb-scan"}, {"tile", "8"}}, cpu(), ExitCode::kUsage,
               {"binning=aabb-scan", "65536 tiles", "1310720 boxes", "larger tile, or binning=exact"});
  checkRefusal(million, {{"binning", "bitmask"}, {"tile", "8"}}, cpu(), ExitCode::kUsage,
               {"binning=bitmask", "10.0 GiB", "larger tile, or binning=exact"});
  DeviceInfo small = vulkan();
  small.maxBufferBytes = 128u << 20;
  checkRefusal(million, {{"binning", "bitmask"}, {"tile", "64"}}, small, ExitCode::kUnsupported,
               {"binning=bitmask", "160 MiB", "test GPU holds 128", "larger tile, or binning=exact"});
  checkRefusal(million, {{"commit", "depth16+id16"}}, cpu(), ExitCode::kUsage,
               {"commit=depth16+id16", "65535 triangles", "1310720", "set commit=depth32+id32 or two-pass"});
  CHECK(makePlan(million, {{"binning", "aabb-scan"}, {"tile", "64"}}, cpu()).resolved.get("tile") == "64");
  CHECK(makePlan(million, {{"binning", "bitmask"}, {"tile", "64"}}, cpu()).resolved.get("tile") == "64");
}

TEST_CASE("Variants that a device cannot run are refused", "[refusals]") {
  checkRefusal(sphere(), {{"route", "spirv"}}, cpu(), ExitCode::kUnsupported,
               {"route=spirv", "for Vulkan devices", "set route=cpp"});
  checkRefusal(sphere(), {{"route", "glsl"}}, cpu(), ExitCode::kUnsupported, {"route=glsl", "for Vulkan devices", "set route=cpp"});
  checkRefusal(sphere(), {{"route", "cpp"}}, vulkan(), ExitCode::kUnsupported,
               {"route=cpp", "for the CPU device", "set route=spirv or glsl"});
  DeviceInfo device = vulkan();
  device.maxGroupBytes = 16384;
  checkRefusal(sphere(), {{"tile", "64"}}, device, ExitCode::kUnsupported,
               {"tile=64", "32768 bytes", "test GPU has 16384", "set a smaller tile"});
  device = vulkan();
  device.atomicMin64 = false;
  checkRefusal(sphere(), {{"commit", "depth32+id32"}}, device, ExitCode::kUnsupported,
               {"commit=depth32+id32", "shaderBufferInt64Atomics", "test GPU", "set commit=two-pass"});
  // Left to the plan, the packing is one that the device has.
  CHECK(makePlan(sphere(), {{"binning", "none"}}, device).resolved.get("commit") == "two-pass");
  CHECK(makePlan(sphere(), {{"binning", "none"}}, vulkan()).resolved.get("commit") == "depth32+id32");
  device = vulkan();
  device.int64 = false;
  checkRefusal(sphere(), {{"wide", "native"}}, device, ExitCode::kUnsupported,
               {"wide=native", "test GPU", "shaderInt64", "set wide=two-word"});
  CHECK(makePlan(sphere(), {}, device).resolved.get("wide") == "two-word");
  device = vulkan();
  device.float64 = false;
  checkRefusal(sphere(), {{"edge", "float64"}}, device, ExitCode::kUnsupported,
               {"edge=float64", "test GPU", "shaderFloat64", "set edge=int32 or int64"});
  checkRefusal(sphere(), {{"commit", "lock"}}, vulkan(), ExitCode::kUnsupported,
               {"commit=lock", "CPU device", "own subgroup", "set commit=depth32+id32 or two-pass"});
}

TEST_CASE("A device with little group memory gets a tile that fits", "[refusals]") {
  DeviceInfo device = vulkan();
  device.maxGroupBytes = 16384;
  CHECK(makePlan(sphere(), {}, device).resolved.get("tile") == "32");
}

TEST_CASE("What a plan chose can be set and chooses the same again", "[refusals]") {
  DeviceInfo every = cpu(), gpu = vulkan();
  for (DeviceInfo* const device : {&every, &gpu}) device->int64 = device->float64 = device->atomicMin64 = true;
  std::vector<std::pair<std::string, std::string>> settings;
  for (const Axis& axis : allAxes()) {
    for (const AxisValue& value : axis.values) settings.emplace_back(axis.name, value.name);
    if (axis.values.empty()) settings.emplace_back(axis.name, std::to_string(axis.least));
  }
  const Scene scene = sphere();
  std::size_t planned = 0;
  for (const DeviceInfo& device : {every, gpu})
    for (const auto& [axis, value] : settings)
      for (const auto& [otherAxis, otherValue] : settings) {
        Variant asked;
        asked.set(axis, value);
        if (axis != otherAxis) asked.set(otherAxis, otherValue);
        Plan plan;
        try {
          plan = makePlan(scene, asked, device);
        } catch (const Error&) {
          continue;  // refused, as it may be
        }
        ++planned;
        const Variant chosen = plan::settable(plan.resolved);
        INFO("asked " << asked.text() << "\nchosen " << chosen.text());
        Plan again;
        REQUIRE_NOTHROW(again = makePlan(scene, chosen, device));
        REQUIRE(plan::settable(again.resolved).text() == chosen.text());
        REQUIRE(again.resolved.get("binning") == plan.resolved.get("binning"));
        for (const auto& name : {axis, otherAxis}) REQUIRE(chosen.get(name) == asked.get(name));  // nothing set is lost
      }
  CHECK(planned > settings.size() * settings.size());
}

TEST_CASE("Sizes of rasters are checked", "[refusals]") {
  for (const auto& [width, height] : {std::pair{0u, 10u}, {10u, 0u}, {32769u, 1u}, {1u, 32769u}}) {
    Scene scene = sphere();
    scene.width = width;
    scene.height = height;
    checkRefusal(scene, {}, cpu(), ExitCode::kUsage, {"width and height go from 1 to 32768"});
  }
}

TEST_CASE("A variant is made from text as it is given and from its own", "[refusals]") {
  const Variant variant(" tile=8\tcommit=two-pass\n binning=queue ");
  CHECK(variant.values() == Variant{{"tile", "8"}, {"commit", "two-pass"}, {"binning", "queue"}}.values());
  CHECK(Variant(variant.text()).values() == variant.values());
  CHECK(Variant("").values().empty());
}

TEST_CASE("Unknown axes and values are refused", "[refusals]") {
  const auto line = [](const char* settings) {
    try {
      const Variant variant(settings);
    } catch (const Error& error) {
      CHECK(error.code() == ExitCode::kUsage);
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  CHECK_THAT(line("tyle=8"), Catch::Contains("tyle") && Catch::Contains("no such axis") && Catch::Contains("tile"));
  CHECK_THAT(line("tile=9"), Catch::Contains("tile=9") && Catch::Contains("8, 16, 32, 64"));
  CHECK_THAT(line("capacity=15"), Catch::Contains("from 16 to 65536"));
  CHECK_THAT(line("capacity=1e3"), Catch::Contains("from 16 to 65536"));
  CHECK_THAT(line("tile"), Catch::Contains("has no value; tile=8 or 16"));
  CHECK_THAT(line("binning=exact capacity"), Catch::Contains("has no value; capacity=16 to capacity=65536"));
  CHECK_THAT(line("tile=8 binning=exact tile=8"), Catch::Contains("--set tile=8: tile is set twice"));
}
