// Stages in other languages, run in place of their own kernels.
#include "host/plan/stages.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "fixture.h"
#include "host/kernels/user-kernel.h"
#include "tests/support/compare.h"
#include "tests/support/random-scene.h"
#include "tests/support/variants.h"

using namespace tessera;
using namespace tessera::test;

TEST_CASE("Transform by hand in GLSL gives the bits of the oracle on random scenes") {
  Machine machine = machineWith("spirv", {{"transform", example("transform.comp")}});
  const auto& bits = axis("sub-pixel").values;  // the image axis that it reads
  std::size_t scenes = 0;
  for (std::uint64_t seed = 0; scenes < 60; ++seed) {
    const Scene scene = randomScene(seed);
    if (scene.positions.empty()) continue;  // given in clip space: nothing to transform
    const Variant image{{"sub-pixel", bits[scenes % bits.size()].name}};
    INFO(scene.name << ", " << image.text());
    CHECK(difference(machine.render(scene, image), oracle::render(scene, oracle::imageAxesOf(image))) == "");
    ++scenes;
  }
}

TEST_CASE("Transform by hand in GLSL gives the bits of Slang stage by stage") {
  Machine byHand = machineWith("spirv", {{"transform", example("transform.comp")}});
  Machine& slang = *machineAt<VulkanSpirv>();
  for (const char* bits : {"0", "4", "8"}) {
    const Variant variant{{"sub-pixel", bits}, {"clip", "on"}, {"projection", "perspective"}};
    const auto stages = [&](Machine& machine) {
      return machine.render(smallScene(), variant, {.keepStages = true}).stages;
    };
    const auto expected = stages(slang);
    REQUIRE(!expected.empty());
    CHECK(difference(stages(byHand), expected) == "");
  }
}

TEST_CASE("Transform by hand leaves nothing to the driver") {
  Machine machine = machineWith("spirv", {});
  for (const char* clip : {"on", "off"}) {
    const Plan plan = machine.plan(smallScene(), {{"clip", clip}, {"projection", "perspective"}});
    const KernelRequest own = plan::kernelRequest("transform", plan);
    const CompiledKernel kernel = machine.kernels().get(kernels::requestOf(own, example("transform.comp")));
    CHECK(kernels::exactnessWarning(kernel) == "");
    const Bench bench;
    const auto careless = bench.edited("transform.comp", {{"precise vec4 c;", "vec4 c;"}});
    CHECK(
        contains(kernels::exactnessWarning(machine.kernels().get(kernels::requestOf(own, careless))), "NoContraction"));
  }
}

TEST_CASE("Shade in HLSL paints what it says") {
  for (const char* route : {"spirv", "glsl"}) {
    Machine machine = machineWith(route, {{"shade", example("by-row.hlsl")}});
    const Framebuffer image = machine.render(smallScene(), {{"shade", "id"}}).image;
    REQUIRE(image.colour.size() == 40 * 24);
    int covered = 0;
    for (std::size_t pixel = 0; pixel < image.ids.size(); ++pixel) {
      const bool empty = image.ids[pixel] == kNoTriangle;
      covered += !empty;
      const glm::vec3 byRow(float(pixel % 40) / 40.0f, float(pixel / 40) / 24.0f, 0);
      CHECK(image.colour[pixel] == (empty ? glm::vec3(0, 0, 1) : byRow));
    }
    CHECK(covered > 100);
    CHECK(covered < 40 * 24);
  }
}

TEST_CASE("HLSL imports the modules of the stage") {
  const Bench bench;
  const auto file =
      bench.edited("by-row.hlsl", {{"struct Frame { uint width, rowBegin, rowEnd; };\nConstantBuffer<Frame> frame;",
                                    "import layout;\nimport settings;"},
                                   {"empty ? 1.0f : 0.0f", "kShade == kShadeId ? 0.25f : 0.5f"}});
  Machine machine = machineWith("spirv", {{"shade", file}});
  CHECK(machine.render(smallScene(), {{"shade", "id"}}).image.colour[0] == glm::vec3(0, 0, 0.25f));
  CHECK(machine.render(smallScene(), {{"shade", "flat"}}).image.colour[0] == glm::vec3(0, 0, 0.5f));
}

TEST_CASE("Shade in Slang reads a buffer that the stage does not and runs on both machines") {
  for (const char* route : {"cpp", "spirv", "glsl"}) {
    Machine machine = machineWith(route, {{"shade", example("by-depth.slang")}});
    const Framebuffer image = machine.render(smallScene(), {{"shade", "id"}}).image;
    REQUIRE(image.colour.size() == image.depth.size());
    for (std::size_t i = 0; i < image.colour.size(); ++i) CHECK(image.colour[i] == glm::vec3(image.depth[i]));
    CHECK(std::ranges::count(image.depth, 1.0f) < 40 * 24 - 100);
  }
}

TEST_CASE("HLSL runs on the CPU where it has one thread a group") {
  const Bench bench;
  const auto file = bench.edited("by-row.hlsl", {{"[numthreads(64, 1, 1)]", R"(#ifdef TESSERA_CPP
void paintOne(uint3 group, uint lane);
[numthreads(1, 1, 1)]
void paint(uint3 group : SV_GroupID)
{
    for (uint lane = 0; lane < 64; ++lane)
        paintOne(group, lane);
}
#define paint paintOne
#else
[numthreads(64, 1, 1)]
#endif)"}});
  Machine cpu = machineWith("cpp", {{"shade", file}}),
          vulkan = machineWith("spirv", {{"shade", example("by-row.hlsl")}});
  const Variant variant{{"shade", "id"}};
  CHECK(cpu.render(smallScene(), variant).image.colour == vulkan.render(smallScene(), variant).image.colour);
}
