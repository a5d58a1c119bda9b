#include "host/variant.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>

#include "host/counters.h"
#include "host/error.h"

namespace tessera {
namespace {

using enum AxisKind;

/// A value that is a Slang file: the file becomes part of the module `variant` and gives `role` its type.
std::string module(std::string_view file, std::string_view role, std::string_view type) {
  return fmt::format("__include {};\npublic typealias {} = {};\n", file, role, type);
}
std::string flag(std::string_view name, bool value) { return fmt::format("public static const bool {} = {};\n", name, value); }
std::string tileSize(int shift) {
  return fmt::format("public static const int kTileSize = {};\npublic static const int kTileShift = {};\n", 1 << shift, shift);
}
std::string cullFlags(bool front, bool back) { return flag("kCullFront", front) + flag("kCullBack", back); }
std::string shadeMode(int mode) {
  return fmt::format("public static const int kShadeId = 1, kShadeFlat = 2, kShadeSmooth = 3;\npublic static const int kShade = {};\n", mode);
}

constexpr bool kTypes = true;

std::vector<Axis> makeAxes() {
  const std::vector<std::string> setup{"setup"}, vertex{"transform", "project", "setup"}, bin{"bin-count", "bin-insert"}, raster{"raster-tiles", "raster-items"};
  const std::vector<std::string> wide{"setup", "bin-count", "bin-insert", "raster-tiles", "raster-items"};
  return {
      {"route", "how the kernels reach the machine", "Slang user guide, chapter on targets", {},
       {{"cpp", "Slang to C++, on the CPU device", ""},
        {"spirv", "Slang to SPIR-V, on a Vulkan device", ""},
        {"glsl", "Slang to GLSL to glslang to SPIR-V, on a Vulkan device", ""}},
       0, 0, "cpp on the CPU device, spirv on a Vulkan device"},
      {"plan", "whether the planner leaves out what a scene does not need", "", {},
       {{"planned", "what the scene does not need is left out", ""}, {"full", "every stage and test runs", ""}},
       0, 0, "planned"},
      {"clip", "clipping in setup", "Sutherland and Hodgman 1974", vertex,
       {{"on", "each triangle is tried against the six planes", flag("kClip", true)},
        {"off", "no plane is tried; refused where the scene crosses one", flag("kClip", false)}},
       0, 0, "off where no triangle can cross a plane"},
      {"projection", "the perspective division", "", vertex,
       {{"perspective", "x, y and z are divided by w", flag("kPerspective", true)},
        {"orthographic", "w is 1 and nothing is divided; refused where it is not", flag("kPerspective", false)}},
       0, 0, "orthographic where every w is 1"},
      {"cull", "which facing is dropped; counter-clockwise on the screen is the front", "", setup,
       {{"none", "both are drawn", cullFlags(false, false), kImage},
        {"back", "clockwise triangles are dropped", cullFlags(false, true), kImage},
        {"front", "counter-clockwise triangles are dropped", cullFlags(true, false), kImage}},
       0, 0, "none"},
      {"between-samples", "dropping pieces whose bounding box holds no sample", "Wihlidal, Optimizing the graphics pipeline with compute, GDC 2016", setup,
       {{"on", "dropped in setup", flag("kCullBetweenSamples", true)}, {"off", "they go on, and are found to be empty later", flag("kCullBetweenSamples", false)}},
       0, 0, "on"},
      {"binning", "how pieces find their tiles", "Laine and Karras, High-performance software rasterization on GPUs, HPG 2011", {},
       {{"none", "no bins: a lane rasterises a piece, or a 64 x 64 block of a larger one, and commits by atomics", ""},
        {"queue", "each tile has a queue of `capacity` entries; what overflows is counted, and retried at the counted size", ""},
        {"exact", "count, prefix sum, scatter: two walks over the pieces, no capacity", ""}},
       0, 0, "exact; none where commit is an atomic one"},
      {"tile", "edge of a tile, pixels", "", {"bin-count", "bin-insert", "raster-tiles"},
       {{"8", "one cell", tileSize(3)}, {"16", "2 x 2 cells", tileSize(4)}, {"32", "4 x 4 cells", tileSize(5)}, {"64", "8 x 8 cells", tileSize(6)}},
       0, 0, "64, or the largest that a device's group memory holds"},
      {"capacity", "entries that a queue starts with", "", {}, {}, 16, 65536, "a power of two, four times the mean number of triangles a tile"},
      {"overflow", "what happens when a queue overflows", "", {},
       {{"retry", "bins run again at the counted sizes", ""},
        {"error", "the frame fails", ""},
        {"drop", "what did not fit is lost, and counted; which pieces those are varies from run to run", "", kApproximate}},
       0, 0, "retry"},
      {"commit", "where a covered sample goes", "", raster,
       {{"tile-owned", "a group owns its tile's depth and ids and writes them back once; no atomics", module("commit_tile_owned", "Commit", "TileOwned")},
        {"depth32+id32", "64-bit atomic min on depth and id in one word", module("commit_depth32_id32", "Commit", "CommitPacked64")},
        {"two-pass", "32-bit atomic min on depth, then on the id of the samples that have it", module("commit_two_pass", "Commit", "CommitTwoPass")},
        {"count", "counts the pieces that cover each sample; no depth, no ids", module("commit_count", "Commit", "CommitCount"), kImage}},
       0, 0, "tile-owned; with binning=none depth32+id32, or two-pass where the device has no 64-bit atomics", kTypes},
      {"traversal", "which pixels test a piece", "Pineda, A parallel algorithm for polygon rasterization, SIGGRAPH 1988", raster,
       {{"pixel", "each pixel of each 8 x 8 cell that meets the bounding box", module("traversal_pixel", "Traversal", "TraversePixels")},
        {"cell-reject", "cells are rejected or accepted whole first", module("traversal_cell_reject", "Traversal", "TraverseCells")}},
       0, 0, "cell-reject", kTypes},
      {"edge", "arithmetic of the edge functions", "", raster,
       {{"int32", "32-bit integers for pieces proved to fit (117 pixels), 64-bit ones elsewhere",
         "__include edge_int64;\n" + module("edge_int32", "EdgeArithmetic", "EdgeInt32")},
        {"int64", "64-bit integers", module("edge_int64", "EdgeArithmetic", "EdgeInt64")}},
       0, 0, "int32", kTypes},
      {"wide", "64-bit integers of setup, bins and edges", "Warren, Hacker's Delight, 2nd edition, 2012, section 8-2", wide,
       {{"native", "the device's own 64-bit integers", "__include wide_native;\n"},
        {"two-word", "pairs of 32-bit words", "__include wide_two_word;\n"}},
       0, 0, "native where the device has 64-bit integers, else two-word"},
      {"counters", "what is counted", "", raster,
       {{"basic", "drops, pieces, bins", flag("kCountWork", false)},
        {"work", "also tests, covered samples and atomics, at a cost", flag("kCountWork", true)}},
       0, 0, "basic"},
      {"shade", "colours of the resolved frame", "Lambert 1760; Olano and Greer 1997 for the weights", {"shade"},
       {{"none", "no colours: the shading stage is left out", shadeMode(0), kImage},
        {"id", "a colour for each triangle id", shadeMode(1), kImage},
        {"flat", "Lambert's cosine of the triangle's normal", shadeMode(2), kImage},
        {"smooth", "Lambert's cosine of the interpolated vertex normals, perspective-correct", shadeMode(3), kImage}},
       0, 0, "none"},
  };
}

const AxisValue& valueOf(const Axis& axis, std::string_view name) {
  const auto found = std::ranges::find(axis.values, name, &AxisValue::name);
  if (found != axis.values.end()) return *found;
  std::vector<std::string_view> names;
  for (const AxisValue& value : axis.values) names.push_back(value.name);
  failUsage(fmt::format("--set {}={}: no such value; there are {}", axis.name, name, fmt::join(names, ", ")));
}

void checkNumber(const Axis& axis, std::string_view text) {
  long number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size() || number < axis.least || number > axis.most)
    failUsage(fmt::format("--set {}={}: takes an integer from {} to {}", axis.name, text, axis.least, axis.most));
}

}  // namespace

const char* kindName(AxisKind kind) {
  return kind == kImage ? "image" : kind == kImplementation ? "implementation" : "approximate";
}

AxisKind Axis::kind() const {
  const auto is = [this](AxisKind k) { return std::ranges::any_of(values, [k](const AxisValue& v) { return v.kind == k; }); };
  return is(kImplementation) || values.empty() ? kImplementation : kImage;
}

const std::vector<Axis>& axes() {
  static const std::vector<Axis> list = makeAxes();
  return list;
}

const Axis& axis(std::string_view name) {
  const auto found = std::ranges::find(axes(), name, &Axis::name);
  if (found != axes().end()) return *found;
  std::vector<std::string_view> names;
  for (const Axis& a : axes()) names.push_back(a.name);
  failUsage(fmt::format("--set {}: no such axis; there are {}", name, fmt::join(names, ", ")));
}

Variant::Variant(std::initializer_list<std::pair<std::string_view, std::string_view>> settings) {
  for (const auto& [name, value] : settings) set(name, value);
}

void Variant::set(std::string_view name, std::string_view value) {
  const Axis& a = axis(name);
  if (a.values.empty()) checkNumber(a, value);
  else valueOf(a, value);
  values_[a.name] = value;
}

void Variant::set(std::string_view assignment) {
  const auto equals = assignment.find('=');
  if (equals == std::string_view::npos) failUsage(fmt::format("--set {}: takes axis=value", assignment));
  set(assignment.substr(0, equals), assignment.substr(equals + 1));
}

bool Variant::has(std::string_view name) const { return values_.contains(std::string(name)); }

std::string Variant::get(std::string_view name, std::string_view otherwise) const {
  const auto found = values_.find(std::string(name));
  return found == values_.end() ? std::string(otherwise) : found->second;
}

std::string Variant::text() const {
  std::vector<std::string> parts;
  for (const Axis& a : axes())
    if (has(a.name)) parts.push_back(a.name + "=" + get(a.name));
  return fmt::format("{}", fmt::join(parts, " "));
}

VariantModules variantModules(std::string_view stage, const Variant& resolved) {
  VariantModules modules{"// Generated: the settings of this stage.\nmodule settings;\n",
                         "// Generated: the types that this stage is made of.\nmodule variant;\n"};
  std::string& text = modules.settings;
  for (const Axis& a : axes())
    if (std::ranges::find(a.stages, stage) != a.stages.end()) (a.types ? modules.variant : text) += valueOf(a, resolved.get(a.name)).slang;
  text += fmt::format("public static const int kCounterCount = {};\n", kernelCounterCount());
  for (std::size_t i = 0; i < kernelCounterCount(); ++i) {
    std::string name = counterDocs()[i].name;
    name[0] = static_cast<char>(std::toupper(name[0]));
    text += fmt::format("public static const uint kCount{} = {};\n", name, i);
  }
  return modules;
}

}  // namespace tessera
