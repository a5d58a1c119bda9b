// A kind of devices is known everywhere once it is registered; here in the library, in command-test.cpp in the command.
#include <tessera/cpu-device.h>
#include <tessera/error.h>
#include <tessera/input.h>
#include <tessera/kernel-cache.h>
#include <tessera/plan.h>
#include <tessera/rasterizer.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <functional>

#include "host/axes/routes.h"
#include "host/devices/open.h"
#include "mirror-kind.h"
#include "tests/support/compare.h"
#include "tests/support/error-line.h"

using namespace tessera;
using namespace tessera::test;

namespace {

Scene scene() { return loadInput("generate:soup?count=300&pixels=60", 96, 64); }

DeviceInfo taking(std::vector<std::string> routes) {
  DeviceInfo info;
  info.name = "a device";
  info.routes = std::move(routes);
  return info;
}

}  // namespace

TEST_CASE("A kind that a program registers is listed and opened by its name") {
  CHECK(devices::findKind("mirror") == nullptr);
  const auto log = std::make_shared<MirrorLog>();
  registerDevice(mirrorKind(log));
  CHECK(deviceKinds().back().name == "mirror");
  CHECK(deviceKinds().front().name == devices::defaultDevice());
  CHECK(std::ranges::count(devices::presentDevices(), "mirror") == 1);
  CHECK(devices::kindNames() == std::vector<std::string>{"cpu", "vulkan", "mirror"});
  CHECK(devices::deviceForms() == "cpu, vulkan, mirror, vulkan:N or vulkan:NAME");
  CHECK(devices::takesThreads("mirror"));
  CHECK(devices::findKind("mirror:0") == nullptr);

  const auto device = openDevice("mirror", {.threads = 2});
  CHECK(device->info().api == "mirror");
  CHECK(device->info().threads == 2);
  CHECK(log->opened == std::vector<std::string>{", 2 threads"});
  CHECK(devices::routeOf(device->info(), {}) == Route::kCpp);
  CHECK(contains(lineOf(ExitCode::kUsage, [] { openDevice("miror"); }), "did you mean mirror?"));
  CHECK(contains(lineOf(ExitCode::kUsage, [] { openDevice("looking-glass"); }), "did you mean mirror?"));
}

TEST_CASE("A frame on a registered kind is the other devices' bit for bit and its device does the work") {
  const auto log = std::make_shared<MirrorLog>();
  registerDevice(mirrorKind(log, "glass"));
  const Scene s = scene();
  const Variant variant{{"shade", "id"}};
  KernelCache kernels;
  const auto frameOn = [&](const std::string& name) {
    const auto device = openDevice(name);
    return Rasterizer(*device, kernels).render(s, variant);
  };
  const Frame mirrored = frameOn("glass");
  CHECK(mirrored.plan.resolved.get("route") == "cpp");
  CHECK(log->buffers > 5);
  CHECK(log->kernels.size() >= mirrored.times.stages.size());
  for (const auto& [stage, ns] : mirrored.times.stages) {
    INFO(stage);
    CHECK(log->dispatches[stage] > 0);
    CHECK(std::ranges::count(log->kernels, stage) == 1);
  }
  CHECK(difference(mirrored, oracle::render(s, oracle::imageAxesOf(variant))) == "");
  for (const std::string other : {"cpu", "vulkan"}) {
    INFO(other);
    CHECK(difference(mirrored.image, frameOn(other).image) == "");
  }
}

TEST_CASE("A kind that could not work is refused in one line when it is registered") {
  const auto refused = [](const std::function<void(DeviceKind&)>& spoil, const std::string& said) {
    DeviceKind kind = mirrorKind(std::make_shared<MirrorLog>(), "pond");
    const std::size_t kinds = deviceKinds().size();
    spoil(kind);
    CHECK(contains(lineOf(ExitCode::kUsage, [&] { registerDevice(kind); }), said));
    CHECK(deviceKinds().size() == kinds);
  };
  refused([](DeviceKind& kind) { kind.name = "cpu"; }, "device kind cpu: there is one of that name");
  for (const char* const name : {"", "a:b", "a/b", "-o", "A"})
    refused([&](DeviceKind& kind) { kind.name = name; }, "not a name");
  refused([](DeviceKind& kind) { kind.routes.clear(); }, "it takes no route; one or more of cpp, spirv, glsl would do");
  refused([](DeviceKind& kind) { kind.routes = {"spriv"}; }, "device kind pond: route spriv: no such route");
  refused([](DeviceKind& kind) { kind.find = nullptr; }, "`find` is empty");
  refused([](DeviceKind& kind) { kind.open = nullptr; }, "`open` is empty");
}

TEST_CASE("A device that is not what its kind says is refused when it is opened") {
  DeviceKind kind = mirrorKind(std::make_shared<MirrorLog>(), "veil");
  kind.open = [](const std::string&, const DeviceOptions&) { return makeCpuDevice(); };
  registerDevice(kind);
  CHECK(contains(lineOf(ExitCode::kFailure, [] { openDevice("veil"); }), "opened as 'cpu'"));
}

TEST_CASE("The plan takes the first route of a device and refuses those that the device does not take") {
  const auto routeOn = [](const DeviceInfo& info, const Variant& variant) {
    return makePlan(scene(), variant, info).resolved.get("route");
  };
  CHECK(routeOn(taking({"spirv", "glsl"}), {}) == "spirv");
  CHECK(routeOn(taking({"glsl", "spirv"}), {}) == "glsl");
  CHECK(routeOn(taking({"glsl", "spirv"}), {{"route", "spirv"}}) == "spirv");
  CHECK(devices::routeOf(taking({"glsl", "spirv"}), {}) == Route::kGlsl);
  CHECK(devices::routeOf(taking({"glsl", "spirv"}), {{"route", "spirv"}}) == Route::kSpirv);
  CHECK(devices::routeOf(taking({"spirv"}), {{"route", "glsl"}}) == Route::kSpirv);
  CHECK(contains(lineOf(ExitCode::kUnsupported,
                        [&] {
                          routeOn(taking({"spirv"}), {{"route", "glsl"}});
                        }),
                 "set route=spirv"));
  CHECK(contains(lineOf(ExitCode::kUsage, [&] { routeOn(taking({}), {}); }), "a device: it names no route"));
}

TEST_CASE("The axis route has the values that the list of routes has") {
  std::vector<std::string> names;
  for (const AxisValue& value : axis("route").values) {
    names.push_back(value.name);
    CHECK(axes::routeInfo(axes::routeNamed(value.name).route).name == value.name);
  }
  CHECK(names == std::vector<std::string>{"cpp", "spirv", "glsl"});
}
