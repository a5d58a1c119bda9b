// The oracle: the contract of rasterizer.h in plain loops and 128-bit integers, one triangle and one pixel at a time.
// The oracle shares no code with slang/ and includes nothing of the pipeline. It is written to be read beside the
// contract.
#pragma once

#include <tessera/framebuffer.h>
#include <tessera/scene.h>

#include <cstdint>
#include <string>
#include <vector>

/// The oracle, which shares no code with the kernels.
namespace tessera::oracle {

/// Which sides of triangles are dropped: the values of the axis `cull`.
enum class Cull {
  kNone,  ///< no side
  kBack,  ///< triangles that are clockwise on the screen
  kFront  ///< triangles that are counter-clockwise on the screen
};
/// Which samples on an edge are covered: the values of the axis `fill`.
enum class Fill {
  kTopLeft,   ///< samples on top and left edges
  kInclusive  ///< samples on all edges
};
/// How depth is computed from the corners: the values of the axis `interpolate`. The contract's section Depth has the
/// formulas.
enum class Interpolate {
  kCellPlane,  ///< by the triangle's plane, rebased to cells of 8 x 8 pixels
  kPlane,      ///< by the triangle's plane
  kWeights     ///< by barycentric weights
};
/// The axes that define the image. When an axis of variant.h gains a value that defines the image, the value joins
/// here.
struct ImageAxes {
  Cull cull = Cull::kNone;                            ///< the axis `cull`
  Fill fill = Fill::kTopLeft;                         ///< the axis `fill`
  Interpolate interpolate = Interpolate::kCellPlane;  ///< the axis `interpolate`
  int subPixelBits = 8;                               ///< the axis `sub-pixel`: 0, 4, 6 or 8
};

/// One oriented and snapped piece, as the section Cover takes it.
struct Piece {
  std::uint32_t id;   ///< id of the piece's triangle
  std::int32_t x[3];  ///< x of each corner, in 1/256 pixel from the left
  std::int32_t y[3];  ///< y of each corner, in 1/256 pixel from the top
  float z[3];         ///< depth of each corner, in [+0, 1]
};

/// What became of the triangles and pieces. A triangle counts in at most one of badIndex, nonFinite and outside. A
/// piece counts in at most one of behind, zeroArea and facing.
struct Counts {
  std::uint64_t submitted = 0;  ///< all triangles
  std::uint64_t badIndex = 0;   ///< triangles with an index out of range
  std::uint64_t nonFinite = 0;  ///< triangles with a clip coordinate that is not finite
  std::uint64_t outside = 0;    ///< triangles of which nothing is inside the clip planes
  std::uint64_t clipped = 0;    ///< triangles with a vertex outside a clip plane; those of `outside` count, too
  std::uint64_t behind =
      0;  ///< pieces with a w that is not > 0, a 1/w that is not finite, or a position that overflowed
  std::uint64_t zeroArea = 0;  ///< pieces of area 0 after snapping
  std::uint64_t facing = 0;    ///< pieces that `cull` drops
  std::uint64_t covered = 0;   ///< samples that pieces cover; a sample counts once for each piece
};

/// What render() gives.
struct Result {
  Framebuffer image;       ///< depth, ids, hits, and the scene's values; in the contract's float32 order
  Counts counts;           ///< what became of the triangles and pieces
  double depthMaxAbs = 0;  ///< largest |float32 depth - exact depth of the snapped piece| over the visible pixels
  double depthMaxUlp = 0;  ///< the same, in units of the last place of the exact value
};

/// The float32 clip positions of a scene, one for each vertex. They are the scene's own where it gives clip positions,
/// and come from the contract's transform otherwise.
std::vector<glm::vec4> transform(const Scene& scene);
/// The pieces of all triangles, in the order of ids, by the contract's sections Clip, Project, Snap and Orient. Where
/// `counts` is not null, it gets all counts but Counts::covered.
std::vector<Piece> pieces(const Scene& scene, const ImageAxes& axes, Counts* counts = nullptr);
/// The image of the scene by the contract. With `measureDepth`, which is slower, depthMaxAbs and depthMaxUlp are
/// filled, too.
Result render(const Scene& scene, const ImageAxes& axes = {}, bool measureDepth = false);

/// Fills the channels of a frame that has ids: one channel for each stream of the scene that is interpolated, by the
/// contract and in its float32 order. The new channels replace frame.channels.
void interpolate(const Scene& scene, const ImageAxes& axes, Framebuffer& frame);

/// The error of the attribute's values A, over the pixels of a frame that show a triangle with finite values, and over
/// all streams that are interpolated, in the streams' units:
///
///     |A - exact value|
///
/// The exact value is the contract's section Attributes in real numbers: the linear interpolation over the snapped
/// triangle, or the perspective-correct interpolation over the triangle in clip space. The exact value is right to
/// about 2^-100 of its terms.
struct AttributeError {
  double max = 0;            ///< largest error
  double rms = 0;            ///< root of the mean square
  std::uint64_t pixels = 0;  ///< how many pixels were measured
};
/// Measures the attribute of a frame, which any device may have rendered. The frame has to hold ids and attribute.
AttributeError attributeError(const Scene& scene, const ImageAxes& axes, const Framebuffer& frame);

}  // namespace tessera::oracle
