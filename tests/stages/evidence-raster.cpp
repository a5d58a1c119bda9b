#include <tessera/kernel-cache.h>

#include "evidence-scenes.h"
#include "host/kernels/spirv.h"
#include "host/plan/stages.h"

namespace tessera::test {
namespace {

std::vector<std::uint32_t> rasterModule(const Variant& variant) {
  KernelCache cache;
  DeviceInfo device;
  device.routes = {"spirv", "glsl"};
  return kernels::readSpirv(cache.get(plan::kernelRequest("raster-tiles", makePlan(Scene{}, variant, device))).binary);
}
/// Instructions of a module that `counts` is true of, by opcode and first operand.
std::size_t instructions(const Variant& variant, const std::function<bool(std::uint32_t, std::uint32_t)>& counts) {
  const std::vector<std::uint32_t> words = rasterModule(variant);
  std::size_t found = 0;
  for (std::size_t at = 5; at < words.size(); at += words[at] >> 16)
    found += counts(words[at] & 0xffff, at + 1 < words.size() ? words[at + 1] : 0);
  return found;
}
bool hasCapability(const Variant& variant, std::uint32_t capability) {
  return instructions(variant, [&](std::uint32_t opcode, std::uint32_t first) {
           return opcode == 17 && first == capability;  // OpCapability
         }) > 0;
}
std::vector<float> depthOf(const Variant& variant) { return on(sphere(), variant).image.depth; }

/// 32 squares over all of one tile, the farthest first.
Scene backToFront() {
  Scene scene;
  scene.width = scene.height = 64;
  for (int layer = 0; layer < 32; ++layer) {
    const float z = 0.9f - 0.02f * float(layer);
    const auto first = static_cast<std::uint32_t>(scene.clip.size());
    for (const auto& [x, y] : {std::pair{-1.0f, -1.0f}, {1.0f, -1.0f}, {1.0f, 1.0f}, {-1.0f, 1.0f}})
      scene.clip.emplace_back(x, y, z, 1.0f);
    scene.triangles.push_back({first, first + 1, first + 2});
    scene.triangles.push_back({first, first + 2, first + 3});
  }
  return scene;
}
Frame layers(const std::string& settings) { return on(backToFront(), Variant(settings)); }

/// What the C++ text of a raster kernel says of its vectors.
int lanesAtOnce(const std::string& width) {
  Variant variant("size-class=shape");
  variant.set("lane-width", width);
  const VariantModules modules =
      plan::kernelRequest("raster-tiles", makePlan(Scene{}, variant, machineAt<Cpu>()->device().info())).modules;
  return modules.laneWidth ? int(modules.laneWidth) : 16;
}

const Evidence kEvidence{
    {"wide",
     {{"native",
       [] {
         CHECK(hasCapability({{"wide", "native"}}, 11));
       }},  // Int64
      {"two-word",
       [] {
         CHECK(!hasCapability({{"wide", "two-word"}}, 11));
         CHECK(difference(on(sphere(), {{"wide", "two-word"}, {"edge", "int64"}}), oracle::render(sphere())) == "");
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
      {"depth32+rgba8",
       [] {
         const Frame frame = on(sphere(), {{"commit", "depth32+rgba8"}});
         CHECK(ran(frame, "payload"));
         CHECK(frame.image.depth == oracle::render(sphere()).image.depth);
         CHECK(std::ranges::count(frame.image.ids, kUnknownTriangle) ==
               std::ssize(frame.image.ids) - std::ranges::count(frame.image.ids, kNoTriangle));
       }},
      {"depth24+lum8",
       [] {
         const Frame frame = on(sphere(), {{"commit", "depth24+lum8"}});
         CHECK(ran(frame, "payload"));
         CHECK(frame.image.depth != oracle::render(sphere()).image.depth);
         CHECK(std::ranges::all_of(frame.image.colour, [](const glm::vec3& c) { return c.x == c.y && c.y == c.z; }));
       }},
      {"depth16+id16",
       [] {
         const Frame frame = on(sphere(), {{"commit", "depth16+id16"}});
         CHECK(ran(frame, "resolve"));
         CHECK(frame.image.depth != oracle::render(sphere()).image.depth);
       }},
      {"lock",
       [] {
         const Frame frame = on(sphere(), {{"commit", "lock"}});
         CHECK(count(frame, "atomics") == 2 * count(frame, "covered"));
         CHECK(difference(frame, oracle::render(sphere())) == "");
       }},
      {"count",
       [] {
         const Frame frame = on(sphere(), {{"commit", "count"}});
         CHECK(frame.image.ids.empty());
         CHECK(frame.image.hits == oracle::render(sphere()).image.hits);
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
       }},
      {"hierarchical",
       [] {
         // One triangle over most of the tile: blocks settle what cells would be asked one by one.
         const Frame cells = on(crossing(), {{"traversal", "cell-reject"}}), blocks = on(crossing(), {{"traversal", "hierarchical"}});
         CHECK(count(blocks, "looks") < count(cells, "looks"));
         CHECK(count(blocks, "tests") == count(cells, "tests"));
       }},
      {"scanline",
       [] {
         // A diagonal sliver: a row has a cell or two, and only those beside them are looked at.
         Scene sliver;
         sliver.width = sliver.height = 64;
         sliver.clip = {{-1, -1, 0.5f, 1}, {1, 1, 0.5f, 1}, {0.95f, 1, 0.5f, 1}};
         sliver.triangles = {{0, 1, 2}};
         const Frame cells = on(sliver, {{"traversal", "cell-reject"}}), rows = on(sliver, {{"traversal", "scanline"}});
         CHECK(count(cells, "looks") == 64);
         CHECK(count(rows, "looks") < 50);
         CHECK(count(rows, "tests") == count(cells, "tests"));
       }}}},
    {"size-class",
     {{"off",
       [] {
         CHECK(count(on(sphere(), {{"size-class", "off"}}), "looks") > 20000);
       }},
      {"on",
       [] {
         // Many of the sphere's triangles lie in one cell, which is tested without a look.
         const Frame on_ = on(sphere(), {{"size-class", "on"}}), off = on(sphere(), {{"size-class", "off"}});
         CHECK(count(on_, "looks") < count(off, "looks"));
         CHECK(count(on_, "tests") > count(off, "tests"));
       }},
      {"shape",
       [] {
         // A tiny triangle tries the samples of its box, and not those of a cell.
         const Frame shape = on(sphere(), {{"size-class", "shape"}, {"hidden", "off"}}), off = on(sphere(), {{"size-class", "off"}});
         CHECK(4 * count(shape, "tests") < count(off, "tests"));
         CHECK(count(shape, "covered") == count(off, "covered"));
         CHECK(count(shape, "visited") == count(off, "visited"));
       }}}},
    {"tile-word",
     {{"split",
       [] {
         CHECK(!hasCapability({{"tile-word", "split"}, {"wide", "two-word"}}, 11));
       }},  // Int64
      {"packed",
       [] {
         CHECK(hasCapability({{"tile-word", "packed"}, {"wide", "two-word"}}, 11));
       }}}},
    {"lane-width",
     {{"native", [] { CHECK(lanesAtOnce("native") >= 4); }},
      {"4", [] { CHECK(lanesAtOnce("4") == 4); }},
      {"8", [] { CHECK(lanesAtOnce("8") == 8); }},
      {"16", [] { CHECK(lanesAtOnce("16") == 16); }}}},
    {"hidden",
     {{"off", [] { CHECK(count(layers("size-class=shape hidden=off"), "covered") == 32 * 64 * 64); }},
      {"tile", [] { CHECK(count(layers("size-class=shape hidden=tile order=nearest-first"), "covered") < 20 * 64 * 64); }},
      {"cell",
       [] {
         // The cells on the diagonals have two pieces a layer, so a bound comes only with the next round of 16 pieces.
         CHECK(count(layers("size-class=shape hidden=cell order=nearest-first"), "covered") < 2 * 64 * 64);
         CHECK(difference(layers("size-class=shape hidden=cell order=nearest-first"), oracle::render(backToFront())) == "");
       }}}},
    {"order",
     // The layers come from back to front, so as they are binned none hides what follows.
     {{"as-binned", [] { CHECK(count(layers("size-class=shape hidden=cell order=as-binned"), "covered") == 32 * 64 * 64); }},
      {"nearest-first", [] { CHECK(count(layers("size-class=shape hidden=cell order=nearest-first"), "covered") < 2 * 64 * 64); }}}},
    {"step",
     // One triangle over all 8 rows of cells of each tile: an evaluation a cell, or one a row.
     {{"direct",
       [] {
         const Frame frame = on(crossing(), {{"step", "direct"}});
         CHECK(count(frame, "evaluations") == count(frame, "looks"));
       }},
      {"incremental",
       [] {
         const Frame frame = on(crossing(), {{"step", "incremental"}});
         CHECK(4 * count(frame, "evaluations") < count(frame, "looks"));
         CHECK(difference(frame, oracle::render(crossing())) == "");
       }}}},
    {"interpolate",
     {{"plane",
       [] {
         CHECK(depthOf({{"interpolate", "plane"}}) != depthOf({{"interpolate", "cell-plane"}}));
       }},
      {"cell-plane",
       [] {
         CHECK(depthOf({{"interpolate", "cell-plane"}}) != depthOf({{"interpolate", "weights"}}));
       }},
      {"weights",
       [] {
         CHECK(depthOf({{"interpolate", "weights"}}) != depthOf({{"interpolate", "plane"}}));
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
           CHECK(difference(on(scene, {{"edge", "int32"}}), oracle::render(scene)) == "");
         }
       }},
      {"int64",
       [] {
         CHECK(difference(on(sphere(), {{"edge", "int64"}}), oracle::render(sphere())) == "");
       }},
      {"float64",
       [] {
         CHECK(hasCapability({{"edge", "float64"}}, 10));   // Float64
         CHECK(!hasCapability({{"edge", "int64"}}, 10));
         CHECK(difference(on(sphere(), {{"edge", "float64"}}), oracle::render(sphere())) == "");
       }},
      {"float32-plane",
       [] {
         CHECK(on(sphere(), {{"edge", "float32-plane"}}).image.depth != oracle::render(sphere()).image.depth);
       }},
      {"float32-difference",
       [] {
         CHECK(on(sphere(), {{"edge", "float32-difference"}}).image.depth !=
               on(sphere(), {{"edge", "float32-plane"}}).image.depth);
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
         CHECK(count(frame, "covered") == oracle::render(sphere()).counts.covered);
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

const Evidence& rasterEvidence() { return kEvidence; }

}  // namespace tessera::test
