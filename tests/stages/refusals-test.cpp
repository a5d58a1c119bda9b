// Variants that a scene or a device cannot have: the exit code of its kind, and a line that says which axis and value,
// why, and what would do.
#include <catch2/catch.hpp>

#include "datasets/input.h"
#include "host/error.h"
#include "host/plan.h"

using namespace tessera;

namespace {

DeviceInfo cpu() {
  DeviceInfo info;
  info.api = "cpu";
  info.name = "test processor";
  return info;
}
DeviceInfo vulkan() {
  DeviceInfo info;
  info.api = "vulkan";
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
  bare.normals.clear();
  checkRefusal(bare, {{"shade", "smooth"}}, cpu(), ExitCode::kUsage,
               {"shade=smooth", "no vertex normals", "set shade=flat"});
}

TEST_CASE("Axes that do not go together are refused", "[refusals]") {
  checkRefusal(sphere(), {{"commit", "tile-owned"}, {"binning", "none"}}, cpu(), ExitCode::kUsage,
               {"commit=tile-owned", "binning=none", "needs bins", "set binning=exact or queue"});
  checkRefusal(sphere(), {{"shade", "flat"}, {"commit", "count"}}, cpu(), ExitCode::kUsage,
               {"shade=flat", "commit=count", "no ids", "set shade=none"});
}

TEST_CASE("Variants that a device cannot run are refused", "[refusals]") {
  checkRefusal(sphere(), {{"route", "spirv"}}, cpu(), ExitCode::kUnsupported,
               {"route=spirv", "cpu device", "route=cpp"});
  checkRefusal(sphere(), {{"route", "glsl"}}, cpu(), ExitCode::kUnsupported, {"route=glsl", "cpu device", "route=cpp"});
  checkRefusal(sphere(), {{"route", "cpp"}}, vulkan(), ExitCode::kUnsupported,
               {"route=cpp", "vulkan device", "route=spirv or route=glsl"});
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
  checkRefusal(sphere(), {}, device, ExitCode::kUnsupported, {"test GPU", "shaderInt64"});
}

TEST_CASE("A device with little group memory gets a tile that fits", "[refusals]") {
  DeviceInfo device = vulkan();
  device.maxGroupBytes = 16384;
  CHECK(makePlan(sphere(), {}, device).resolved.get("tile") == "32");
}

TEST_CASE("Sizes of rasters are checked", "[refusals]") {
  for (const auto& [width, height] : {std::pair{0u, 10u}, {10u, 0u}, {32769u, 1u}, {1u, 32769u}}) {
    Scene scene = sphere();
    scene.width = width;
    scene.height = height;
    checkRefusal(scene, {}, cpu(), ExitCode::kUsage, {"width and height go from 1 to 32768"});
  }
}

TEST_CASE("Unknown axes and values are refused", "[refusals]") {
  const auto line = [](const char* assignment) {
    try {
      Variant().set(assignment);
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
  CHECK_THAT(line("tile"), Catch::Contains("axis=value"));
}
