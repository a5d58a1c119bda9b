// The validation layer has nothing to say about frames of every kind.
#include <tessera/error.h>
#include <tessera/input.h>
#include <tessera/rasterizer.h>
#include <tessera/vulkan-device.h>

#include <catch2/catch.hpp>

#include "all-kernels.h"
#include "host/measure/row.h"
#include "tests/support/compare.h"
#include "tests/support/variants.h"

using namespace tessera;
using namespace tessera::test;

namespace {

/// Frames of one device; what the layer says about them.
class Watched {
 public:
  explicit Watched(bool boundsChecks = false) {
    VulkanOptions options;
    options.boundsChecks = boundsChecks;
    options.validation = true;
    options.onMessage = [this](const std::string& message) { messages.push_back(message); };
    device_ = makeVulkanDevice(options);
    rasterizer_ = std::make_unique<Rasterizer>(*device_, cache_);
  }
  ~Watched() {
    rasterizer_.reset();
    device_.reset();
    CHECK(messages == std::vector<std::string>{});
  }
  Frame render(const Scene& scene, const Variant& variant) {
    INFO(scene.name << " [" << variant.text() << "]");
    Frame frame = rasterizer_->render(scene, variant);
    CHECK((measure::coveredPixels(frame.image) > 0) == !scene.triangles.empty());
    CHECK(messages == std::vector<std::string>{});
    return frame;
  }

  const DeviceInfo& info() const { return device_->info(); }

  std::vector<std::string> messages;

 private:
  KernelCache cache_;
  std::unique_ptr<Device> device_;
  std::unique_ptr<Rasterizer> rasterizer_;
};

Scene sphere() { return loadInput("generate:icosphere?level=3", 301, 203); }

}  // namespace

TEST_CASE("validation is silent over each binning and commit") {
  const Scene scene = sphere();
  for (const char* route : {"spirv", "glsl"}) {
    Watched watched;
    int frames = 0;
    for (const AxisValue& binning : axis("binning").values)
      for (const AxisValue& commit : axis("commit").values) {
        const Variant variant{{"route", route}, {"binning", binning.name}, {"commit", commit.name}};
        if (!isAccepted(variant, watched.info())) continue;
        watched.render(scene, variant);
        ++frames;
      }
    CHECK(frames == 5 * 7 - 1);  // the lock is the CPU's, and without bins no tile is owned
  }
}

TEST_CASE("validation is silent over the other axes") {
  const Scene scene = sphere();
  Watched watched;
  int frames = 0;
  for (const Axis& a : allAxes())
    for (const AxisValue& value : a.values) {
      const Variant variant{{a.name, value.name}};
      // The sphere is in perspective, which no plan for an empty scene knows.
      if (value.name == "orthographic" || !isAccepted(variant, watched.info())) continue;
      watched.render(scene, variant);
      ++frames;
    }
  CHECK(frames > 40);
}

TEST_CASE("validation is silent over retries and clipping and empty frames") {
  Watched watched;
  const Scene hot = loadInput("generate:hot?count=3000&block=16", 256, 256);
  CHECK(watched.render(hot, {{"binning", "queue"}, {"capacity", "16"}}).counters.at("retries") > 0);
  const Scene ring = loadInput(TESSERA_SOURCE_DIR "/datasets/scenes/inside-ring.toml", 301, 203);
  CHECK(watched.render(ring, {}).counters.at("clipped") > 0);
  CHECK(watched.render(ring, {{"commit", "two-pass"}}).counters.at("clipped") > 0);
  Scene empty;
  empty.width = empty.height = 17;
  CHECK(measure::coveredPixels(watched.render(empty, {}).image) == 0);
}

TEST_CASE("validation is silent over bounds checks, which find nothing in our kernels and change no bit") {
  const Scene scene = loadInput("generate:icosphere?level=2", 101, 77, {.name = "x", .range = {}});
  for (const char* route : {"spirv", "glsl"}) {
    Watched checked(true);
    const std::vector<Variant> variants = eachAlone({{"route", route}}, checked.info());
    CHECK(variants.size() > 20);
    for (const Variant& variant : variants) {
      const Frame frame = checked.render(scene, variant);
      CHECK(difference(frame, oracle::render(scene, oracle::imageAxesOf(frame.plan.resolved))) == "");
    }
  }
}
