// THE list: every axis and value that there is. A value is a line here and, mostly, a Slang file.
#include <fmt/format.h>
#include <tessera/variant.h>

#include "host/axes/routes.h"

namespace tessera {
namespace {

using enum AxisKind;
using Stages = std::vector<std::string>;

/// A value that is a Slang file: the file becomes part of the module `variant` and gives `role` its type.
std::string type(std::string_view role, std::string_view file, std::string_view name) {
  return fmt::format("__include {};\npublic typealias {} = {};\n", file, role, name);
}
std::string include(std::string_view file) { return fmt::format("__include {};\n", file); }
std::string flag(std::string_view name, bool value) {
  return fmt::format("public static const bool {} = {};\n", name, value);
}
std::string number(std::string_view name, int value) {
  return fmt::format("public static const int {} = {};\n", name, value);
}
std::string tileSize(int shift) { return number("kTileSize", 1 << shift) + number("kTileShift", shift); }
std::string cullFlags(bool front, bool back) { return flag("kCullFront", front) + flag("kCullBack", back); }
std::string shadeMode(int mode) {
  return number("kShadeId", 1) + number("kShadeFlat", 2) + number("kShadeSmooth", 3) + number("kShade", mode);
}

constexpr bool kTypes = true;
const Stages kSetup{"setup"}, kVertex{"transform", "project", "setup"}, kRaster{"raster-tiles", "raster-items"};
const Stages kSetupToRaster{"setup", "bin-count", "bin-insert", "raster-tiles", "raster-items"};

std::vector<Axis> vertexAxes() {
  return {
      routeAxis(),
      {"plan",
       "whether the planner leaves out what a scene does not need",
       "",
       {},
       {{"planned", "what the scene does not need is left out", ""}, {"full", "every stage and test runs", ""}},
       "planned"},
      {"clip",
       "clipping in setup",
       "Sutherland and Hodgman, CACM 1974",
       kVertex,
       {{"on", "each triangle is tried against the six planes", flag("kClip", true)},
        {"off", "no plane is tried", flag("kClip", false), kImplementation, 0, "",
         "refused where the scene crosses a plane"}},
       "off where no triangle can cross a plane"},
      {"projection",
       "the perspective division",
       "",
       kVertex,
       {{"perspective", "x, y and z are divided by w", flag("kPerspective", true)},
        {"orthographic", "w is 1 and nothing is divided", flag("kPerspective", false), kImplementation, 0, "",
         "refused where a w is not 1"}},
       "orthographic where every w is 1"},
      {"sub-pixel",
       "bits of a position below the pixel",
       "Direct3D 11.3 functional specification: 8 bits",
       kVertex,
       {{"0", "vertices on the samples: integer vertices", number("kSubPixelBits", 0), kImage},
        {"4", "1/16 pixel", number("kSubPixelBits", 4), kImage},
        {"6", "1/64 pixel", number("kSubPixelBits", 6), kImage},
        {"8", "1/256 pixel", number("kSubPixelBits", 8), kImage}},
       "8"},
      {"cull",
       "which facing is dropped; counter-clockwise on the screen is the front",
       "",
       kSetup,
       {{"none", "both are drawn", cullFlags(false, false), kImage},
        {"back", "clockwise triangles are dropped", cullFlags(false, true), kImage},
        {"front", "counter-clockwise triangles are dropped", cullFlags(true, false), kImage}},
       "none"},
      {"fill",
       "whether a sample on an edge is covered",
       "Direct3D 11.3 functional specification, on the top-left rule",
       kSetupToRaster,
       {{"top-left", "on top and left edges only: a shared edge is covered once", flag("kInclusive", false), kImage},
        {"inclusive", "on every edge, so a shared edge is covered twice", flag("kInclusive", true), kImage}},
       "top-left"},
      {"between-samples",
       "dropping pieces whose bounding box holds no sample",
       "Wihlidal, Optimizing the graphics pipeline with compute, GDC 2016",
       kSetup,
       {{"on", "dropped in setup", flag("kCullBetweenSamples", true)},
        {"off", "they go on, and are found to be empty later", flag("kCullBetweenSamples", false)}},
       "on"},
      {"compact",
       "leaving no empty slots among the pieces that go on from setup",
       "Wihlidal, Optimizing the graphics pipeline with compute, GDC 2016",
       kSetup,
       {{"off", "a triangle's first piece has the slot of its triangle; a dropped one leaves it empty",
         flag("kCompact", false)},
        {"on", "a group of lanes takes as many slots as it has pieces", flag("kCompact", true)}},
       "off"},
      {"wide",
       "64-bit integers of setup, bins, edges and values",
       "Warren, Hacker's Delight, 2nd edition, 2012, section 8-2",
       {"setup", "bin-count", "bin-insert", "raster-tiles", "raster-items", "attribute"},
       {{"native", "the device's own", include("wide_native"), kImplementation, kNeedsInt64},
        {"two-word", "pairs of 32-bit words", include("wide_two_word")}},
       "native where the device has 64-bit integers"},
  };
}

std::vector<Axis> binAxes() {
  const std::string lists = type("Bins", "binning.lists", "BinLists");
  return {
      {"binning",
       "how pieces find their tiles",
       "",
       {"bin-insert", "raster-tiles"},
       {{"none", "no bins: a lane rasterises a piece, or a 64 x 64 block of a larger one", "", kImplementation, 0,
         "Liu et al., FreePipe, I3D 2010"},
        {"aabb-scan", "no bins: each tile goes through the bounding boxes of all pieces",
         type("Bins", "binning.scan", "BinScan"), kImplementation, 0, "", "refused beyond 2^32 boxes a frame"},
        {"queue", "each tile has a queue of `capacity` entries; what overflows is counted, and retried", lists,
         kImplementation, 0, "Laine and Karras, High-performance software rasterization on GPUs, HPG 2011"},
        {"exact", "count, prefix sum, scatter: two walks over the pieces, no capacity", lists, kImplementation, 0,
         "Blelloch, Prefix sums and their applications, 1990"},
        {"bitmask", "a bit for each pair of a tile and a piece", type("Bins", "binning.bitmask", "BinMask"),
         kImplementation, 0, "Drobot, Improved culling for tiled and clustered rendering, SIGGRAPH 2017 courses",
         "refused beyond 4 GiB of bits, or what a buffer of the device holds"}},
       "exact; queue where capacity or overflow is set; none where commit is an atomic one",
       kTypes},
      {"tile",
       "edge of a tile, pixels",
       "",
       {"clear", "bin-count", "bin-insert", "raster-tiles"},
       {{"8", "one cell", tileSize(3)},
        {"16", "2 x 2 cells", tileSize(4)},
        {"32", "4 x 4 cells", tileSize(5)},
        {"64", "8 x 8 cells", tileSize(6)}},
       "64, or the largest that a device's group memory holds"},
      {"tile-test",
       "which tiles and blocks of its bounding box a piece goes to",
       "Akenine-Moeller and Aila, Conservative and tiled rasterization, JGT 2005",
       {"setup", "bin-count", "bin-insert"},
       {{"edges", "those that none of its edges rejects", flag("kTestTileEdges", true)},
        {"box", "all of them", flag("kTestTileEdges", false)}},
       "edges; box where edge is an inexact one"},
      {.name = "capacity",
       .meaning = "entries that a queue starts with",
       .unset = "a power of two, four times the mean number of triangles a tile",
       .least = 16,
       .most = 65536},
      {"overflow",
       "what happens when a queue overflows",
       "",
       {},
       {{"retry", "bins run again at the counted sizes", ""},
        {"error", "the frame fails", ""},
        {"drop", "what did not fit is lost, and counted", "", kApproximate, 0, "",
         "which pieces are lost varies from run to run"}},
       "retry"},
  };
}

std::vector<Axis> rasterAxes() {
  const std::string int64 = include("edge.int64"), float32 = include("edge.float32");
  return {
      {"commit",
       "where a covered sample goes",
       "",
       {"clear", "payload", "raster-tiles", "raster-items", "resolve"},
       {{"tile-owned", "a group owns its tile's depth and ids and writes them back once; no atomics",
         type("Commit", "commit.tile_owned", "TileOwned"), kImplementation, kWritesTiles, "Laine and Karras, HPG 2011"},
        {"depth32+id32", "64-bit atomic min on depth and id in one word",
         type("Commit", "commit.depth32_id32", "CommitDepth32Id32"), kImplementation,
         kNeedsInt64 | kNeedsAtomics64 | kResolves, "Karis et al., A deep dive into Nanite, SIGGRAPH 2021 courses"},
        {"depth32+rgba8", "64-bit atomic min on depth and the triangle's colour",
         type("Commit", "commit.depth32_rgba8", "CommitDepth32Rgba8"), kApproximate,
         kNeedsInt64 | kNeedsAtomics64 | kResolves | kKeepsColours,
         "Schuetz et al., Rendering point clouds with compute shaders and vertex order optimization, CGF 2021",
         "no ids; a channel is off by at most 0.5/255 + 2^-20 where the right triangle won"},
        {"two-pass", "32-bit atomic min on depth, then on the id of the samples that have it",
         type("Commit", "commit.two_pass", "CommitTwoPass"), kImplementation, kTwoPasses},
        {"depth24+lum8", "32-bit atomic min on 24 bits of depth and 8 of luminance",
         type("Commit", "commit.depth24_lum8", "CommitDepth24Lum8"), kApproximate, kResolves | kKeepsColours, "",
         "no ids, no hues; depth is off by at most 2^-23"},
        {"depth16+id16", "32-bit atomic min on 16 bits of depth and 16 of id",
         type("Commit", "commit.depth16_id16", "CommitDepth16Id16"), kApproximate, kResolves, "",
         "depth is off by at most 0.5/65535 + 2^-23; refused beyond 65,535 triangles"},
        {"lock", "a spin lock a pixel around plain reads and writes", type("Commit", "commit.lock", "CommitLock"),
         kImplementation, kNeedsCpu, "", "a lane that waits for one of its own subgroup would wait for ever on a GPU"},
        {"count", "counts the pieces that cover each sample; no depth, no ids",
         type("Commit", "commit.count", "CommitCount"), kImage}},
       "tile-owned; with binning=none depth32+id32, or two-pass where the device has no 64-bit atomics",
       kTypes},
      {"size-class",
       "whether micro, middle and large pieces take different walks",
       "",
       kRaster,
       {{"off", "every piece is traversed", type("SizeClass", "size_class.off", "SizeClassOff")},
        {"on", "one cell: tested at once; a covered block: filled; the others: traversed",
         type("SizeClass", "size_class.on", "SizeClassOn")}},
       "off",
       kTypes},
      {"traversal",
       "which cells of its bounding box a piece visits, and in which order",
       "Pineda, A parallel algorithm for polygon rasterization, SIGGRAPH 1988",
       kRaster,
       {{"pixel", "all 8 x 8 cells, and each of their pixels tests",
         type("Traversal", "traversal.pixel", "TraversePixels")},
        {"cell-reject", "all cells, rejected or accepted whole first",
         type("Traversal", "traversal.cell_reject", "TraverseCells")},
        {"hierarchical", "blocks of 32 x 32, of 16 x 16, then cells, each rejected or accepted whole first",
         type("Traversal", "traversal.hierarchical", "TraverseHierarchy"), kImplementation, 0,
         "Greene, Hierarchical polygon tiling with coverage masks, SIGGRAPH 1996"},
        {"scanline", "in each row of cells from the first that is not rejected to the last",
         type("Traversal", "traversal.scanline", "TraverseScanlines")}},
       "cell-reject",
       kTypes},
      {"step",
       "how the edge functions get from cell to cell of a row",
       "Pineda 1988",
       kRaster,
       {{"direct", "evaluated at each cell", type("Step", "step.direct", "StepDirect")},
        {"incremental", "stepped by exact additions; depth is never accumulated",
         type("Step", "step.incremental", "StepIncremental")}},
       "direct",
       kTypes},
      {"edge",
       "arithmetic of the edge functions",
       "",
       kRaster,
       {{"int32", "32-bit integers for pieces proved to fit (117 pixels), 64-bit ones elsewhere",
         int64 + type("EdgeArithmetic", "edge.int32", "EdgeInt32")},
        {"int64", "64-bit integers (see wide)", type("EdgeArithmetic", "edge.int64", "EdgeInt64")},
        {"float64", "64-bit floats, exact below 2^53", type("EdgeArithmetic", "edge.float64", "EdgeFloat64"),
         kImplementation, kNeedsFloat64},
        {"float32-plane", "a x + b y + c in float32",
         float32 + type("EdgeArithmetic", "edge.float32_plane", "EdgeFloat32<PlaneValue>"), kApproximate, 0,
         "McCool, Wales and Moule, Incremental and hierarchical Hilbert order edge equation polygon rasterization, "
         "Graphics Hardware 2001",
         "a sample is wrong only where |E| <= 6 * 2^-24 (|a| (|x| + |X|) + |b| (|y| + |Y|))"},
        {"float32-difference", "a (x - X) + b (y - Y) in float32",
         float32 + type("EdgeArithmetic", "edge.float32_difference", "EdgeFloat32<DifferenceValue>"), kApproximate, 0,
         "Pineda 1988", "a sample is wrong only where |E| <= 5 * 2^-24 (|a (x - X)| + |b (y - Y)|)"}},
       "int32",
       kTypes},
      {"interpolate",
       "depth of a sample from its piece",
       "",
       kRaster,
       {{"plane", "the float32 plane from vertex 0", type("Interpolation", "interpolate.plane", "InterpolatePlane"),
         kImage},
        {"cell-plane", "the plane, rebased to each 8 x 8 cell by the exact edge functions",
         type("Interpolation", "interpolate.cell_plane", "InterpolateCellPlane"), kImage},
        {"weights", "barycentric weights from the exact edge functions of each sample",
         type("Interpolation", "interpolate.weights", "InterpolateWeights"), kImage}},
       "cell-plane",
       kTypes},
      {"counters",
       "what is counted",
       "",
       kRaster,
       {{"basic", "drops, pieces, bins; the work in a result row is counted in a frame of its own",
         flag("kCountWork", false)},
        {"work", "also tests, covered samples and atomics, at a cost", flag("kCountWork", true)}},
       "basic"},
      {"shade",
       "colours of the resolved frame",
       "Lambert 1760; Olano and Greer, Graphics Hardware 1997, for the weights",
       {"payload", "shade"},
       {{"none", "no colours: the shading stage is left out", shadeMode(0), kImage},
        {"id", "a colour for each triangle id", shadeMode(1), kImage},
        {"flat", "Lambert's cosine of the triangle's normal", shadeMode(2), kImage},
        {"smooth", "Lambert's cosine of the interpolated vertex normals, perspective-correct", shadeMode(3), kImage}},
       "none; flat (id where there are no positions in object space) where the commit keeps colours"},
  };
}

}  // namespace

const std::vector<Axis>& axes() {
  static const std::vector<Axis> list = [] {
    std::vector<Axis> all = vertexAxes();
    for (auto* more : {&binAxes, &rasterAxes})
      for (Axis& axis : more()) all.push_back(std::move(axis));
    return all;
  }();
  return list;
}

const std::vector<AxisRule>& axisRules() {
  static const std::vector<AxisRule> list{
      {"capacity", {}, "binning", {"queue"}, "only queues have a capacity"},
      {"overflow", {}, "binning", {"queue"}, "only queues overflow"},
      {"tile", {}, "binning", {"aabb-scan", "queue", "exact", "bitmask"}, "without bins there are no tiles"},
      {"tile-test",
       {"edges"},
       "edge",
       {"int32", "int64", "float64"},
       "an inexact edge may cover samples of a tile that the exact one rejects"},
      {"commit",
       {"tile-owned"},
       "binning",
       {"aabb-scan", "queue", "exact", "bitmask"},
       "it owns tiles, and binning=none has none"},
      {"commit",
       {"depth32+rgba8", "depth24+lum8"},
       "shade",
       {"id", "flat"},
       "it keeps one colour a triangle, made before raster"},
      {"commit", {"count"}, "shade", {"none"}, "it keeps no ids to shade"},
      {"step",
       {"incremental"},
       "edge",
       {"int32", "int64", "float64"},
       "an inexact edge would round again at each step"},
  };
  return list;
}

}  // namespace tessera
