// Tessera turns triangles into a visibility buffer by compute kernels, with the same bits on every device.
//
// THE CONTRACT. What an image is does not depend on device, scheduling, tile size, capacity or lossless packing.
// Arithmetic is float32 + - x, correctly rounded, in the order written, and never contracted. The operations / and sqrt
// are correctly rounded, too. W and H are the width and the height of the raster in pixels.
//
//   Coordinates  Clip space is Vulkan's: x points right, y points down, and
//                    0 <= z <= w
//                The sample of pixel (i, j) lies at
//                    (i + 0.5, j + 0.5)
//                Row 0 is the top row. Rasters are from 1 x 1 to 32768 x 32768 pixels.
//
//   Ids          Triangle i of the scene has the id i. Each piece that clipping makes of a triangle keeps the
//                triangle's id.
//
//   Positions    The positions x, y, z are the scene's. Each is the input's position in double, less the scene's origin
//                (Scene::origin), rounded to float32.
//
//   Transform    For each row r of the matrix m:
//                    clip[r] = ((m[r][0] x + m[r][1] y) + m[r][2] z) + m[r][3]
//
//   Dropped      A triangle is dropped where one of its indices is out of range. Otherwise a triangle is dropped where
//                one of its clip coordinates is not finite. Each of the two causes has its counter.
//
//   Clip         The guard band, with one float32 division for each of the two:
//                    Gx = 32767 / (W/2)
//                    Gy = 32767 / (H/2)
//                The planes in their order. Beside each plane stand the signed distance d of a vertex from the plane,
//                and the value that a new vertex on the plane gets as its clipped coordinate:
//                    z >= 0         d = z           z = 0
//                    z <= w         d = w - z       z = w
//                    x >= -Gx w     d = Gx w + x    x = -(Gx w)
//                    x <= Gx w      d = Gx w - x    x = Gx w
//                    y >= -Gy w     d = Gy w + y    y = -(Gy w)
//                    y <= Gy w      d = Gy w - y    y = Gy w
//                A vertex is inside when d >= 0, and outside otherwise. A plane changes nothing where no vertex of the
//                polygon is outside. Otherwise the algorithm of Sutherland and Hodgman runs from the polygon's first
//                vertex on. For each edge (current, next) the current vertex is kept if it is inside. If exactly one
//                end of the edge is inside, a new vertex p follows, from the inside end to the outside end:
//                    t = d_in / (d_in - d_out)
//                    p = p_in + t (p_out - p_in)    for x, y, z, w
//                Then the clipped coordinate of p is set exactly, to the value in the table above. The polygon
//                v0 v1 v2 v3 ... is cut into a fan of pieces:
//                    (v0, v1, v2), (v0, v2, v3), ...
//
//   Project      For each vertex of a piece:
//                    r = 1/w
//                    sx = (x r)(W/2) + W/2
//                    sy = (y r)(H/2) + H/2
//                The depth of the vertex is z r, clamped:
//                    (z r > 0) ? ((z r < 1) ? z r : 1) : +0
//                A piece is dropped, and counted as behind, where one of its vertices has a w that is not > 0, an r
//                that is not finite, or a snapped X or Y that is not within 2^24 either way. (The guard band keeps X
//                and Y within 2^24, unless clipping overflowed float32.)
//
//   Snap         With b sub-pixel bits, n is sx * 2^b rounded to the nearest integer, ties to even:
//                    s = sx * 2^b
//                    n = floor(s)
//                    d = s - n
//                    n + 1 takes the place of n if d > 1/2, or if d = 1/2 and n is odd
//                    X = n 2^(8 - b)
//                With b = 0 positions go to the samples themselves. The rounding of s to n stays the same, but:
//                    s = sx - 0.5
//                    X = 256 n + 128
//                A triangle then has integer vertices, and samples lie on the vertices. Y is computed from sy as X from
//                sx. X and Y are in 1/256 pixel, whatever b is.
//
//   Orient       Twice the signed area, exact:
//                    area2 = (X1 - X0)(Y2 - Y0) - (X2 - X0)(Y1 - Y0)
//                A piece is dropped where area2 is 0. Where area2 is negative, the piece is a front (counter-clockwise
//                on the screen), and vertices 1 and 2 are swapped. The sections Cover and Depth see area2 > 0.
//
//   Cover        At the sample
//                    p = (256 i + 128, 256 j + 128)
//                the edges 0->1, 1->2, 2->0 have the edge functions, exact:
//                    E_ab(p) = (Xb - Xa)(py - Ya) - (Yb - Ya)(px - Xa)
//                The sample is covered when for each edge E > 0, or E = 0 where the edge is a top edge or a left edge:
//                    top edge:   Yb = Ya, Xb > Xa
//                    left edge:  Yb < Ya
//                With fill=inclusive the sample is covered when for each edge E >= 0.
//
//   Depth        float(int64) rounds once, to nearest even. The slopes of depth:
//                    r = 1 / float(area2)
//                    d1 = z1 - z0
//                    d2 = z2 - z0
//                    zx = ((float(Y2 - Y0) * 256) * r) * d1 + ((float(Y0 - Y1) * 256) * r) * d2
//                    zy = ((float(X0 - X2) * 256) * r) * d1 + ((float(X1 - X0) * 256) * r) * d2
//                Depth is rebased to the fixed 8 x 8 cell of the pixel. P is the sample of the cell's first pixel,
//                    (i - i % 8, j - j % 8)
//                and depth is
//                    zc = z0 + ((float(E_20(P)) * r) * d1 + (float(E_01(P)) * r) * d2)
//                    z = (zc + zx * float(i % 8)) + zy * float(j % 8)
//                With interpolate=plane, depth is instead
//                    z = (z0 + zx * (float(px - X0) / 256)) + zy * (float(py - Y0) / 256)
//                With interpolate=weights, depth is instead
//                    z = z0 + ((float(E_20(p)) * r) * d1 + (float(E_01(p)) * r) * d2)
//                Each z is then kept within the piece. zmin and zmax are the least and the largest of z0, z1, z2:
//                    z = (z > zmin) ? z : zmin
//                    z = (z < zmax) ? z : zmax
//                (So no sample is nearer than the nearest vertex of its piece. This makes it exact to reject a piece
//                by zmin, and keeps slivers bounded.)
//
//   Visible      The smaller depth wins. At equal depth the lower id wins. An empty pixel has the id 4294967295 and the
//                depth 1.0. A sample of depth 1.0 is drawn.
//
//   Attributes   v0 v1 v2 is the triangle of the pixel's id, as it was before clipping and orientation. a0 a1 a2 are
//                its values. The attribute is
//                    A = (w0 a0 + w1 a1) + w2 a2
//                kept within a0, a1, a2 as depth is kept within its piece. Where the clip coordinates w of the three
//                vertices are equal and no vertex is outside a clip plane, the weights w0, w1, w2 are linear on the
//                screen, over the snapped X and Y. With E and area2 by the formulas above:
//                    w0 = float(E_12(p)) / float(area2)
//                    w1 = float(E_20(p)) / float(area2)
//                    w2 = float(E_01(p)) / float(area2)
//                Elsewhere the weights are perspective-correct. In clip space the pixel is at
//                    px = ((i + 0.5) - W/2) / (W/2)
//                    py = ((j + 0.5) - H/2) / (H/2)
//                The clip coordinates xk, yk, wk of each vertex k become
//                    xk = xk - px wk
//                    yk = yk - py wk
//                From them follow
//                    u0 = x1 y2 - x2 y1
//                    u1 = x2 y0 - x0 y2
//                    u2 = x0 y1 - x1 y0
//                Each u is negated where (u0 + u1) + u2 < 0. Then, for each u,
//                    u = (u > 0) ? u : 0
//                The weight of each vertex k is
//                    wk = uk / ((u0 + u1) + u2)
//                Where the sum (u0 + u1) + u2 is then not > 0, the weights are 1, 0, 0.
//                A is NaN, 0x7fc00000, in an empty pixel, and where one of a0, a1, a2 is not finite.
#pragma once

#include <tessera/counters.h>
#include <tessera/device.h>
#include <tessera/framebuffer.h>
#include <tessera/plan.h>
#include <tessera/scene.h>
#include <tessera/variant.h>

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tessera {

class KernelCache;

/// What a frame counted, by the counters' names. counterDocs() lists the names and their meanings.
using Counters = std::map<std::string, std::uint64_t>;

/// How long a frame took, in nanoseconds of DeviceInfo::timeClock.
struct FrameTimes {
  std::uint64_t totalNs = 0;                                  ///< first dispatch to finished visibility buffer
  std::vector<std::pair<std::string, std::uint64_t>> stages;  ///< the sum for each stage, in pipeline order
};

/// What a stage wrote. The order of the elements does not depend on scheduling, so two devices can be compared stage by
/// stage.
struct StageOutput {
  std::string stage;                  ///< the stage's name
  std::string element;                ///< what one element is
  std::size_t words = 1;              ///< 32-bit words in each element
  std::vector<std::uint32_t> values;  ///< `words` words for each element
};

/// What render() gives.
struct Frame {
  Framebuffer image;                ///< empty where FrameOptions::readBack is false
  Counters counters;                ///< what was counted
  FrameTimes times;                 ///< how long it took
  Plan plan;                        ///< what ran, what was left out, and why
  std::vector<StageOutput> stages;  ///< in pipeline order; empty where the frame ran in several bands or batches
};

/// What a frame gives beside its counters and times.
struct FrameOptions {
  bool readBack = true;     ///< fill Frame::image
  bool countWork = false;   ///< also count tests, covered samples and atomics (slower kernels)
  bool keepStages = false;  ///< fill Frame::stages
};

/// Renders scenes on one device. A rasterizer keeps its kernels and buffers between frames.
/// It throws an Error: kUnsupported for a variant that the device cannot run, kOverflow under overflow=error.
class Rasterizer {
 public:
  Rasterizer(Device& device, KernelCache& kernels);  ///< both have to outlive the rasterizer
  ~Rasterizer();
  Rasterizer(const Rasterizer&) = delete;

  /// Renders the scene once. The plan chooses the values of axes that `variant` does not set. Throws kUsage for axes
  /// that do not go together or do not go with the scene, and the other codes as the class says.
  Frame render(const Scene& scene, const Variant& variant = {}, const FrameOptions& options = {});

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace tessera
