// Tessera: triangles to a visibility buffer, by compute kernels, the same bits on every device.
//
// THE CONTRACT. What an image is does not depend on device, scheduling, tile size, capacity or lossless packing.
// Arithmetic is float32 + - x, correctly rounded, in the order written, never contracted; / and sqrt correctly rounded.
//
//   Coordinates  Clip space is Vulkan's: x right, y down, 0 <= z <= w. Pixel (i, j) is sampled at (i + 0.5, j + 0.5);
//                row 0 is the top one. Rasters are 1 x 1 to 32768 x 32768.
//   Ids          Triangle i of the scene has id i; each piece that clipping makes of it keeps that id.
//   Positions    x, y, z are the scene's: the input's in double, less the scene's origin (Scene::origin), in float32.
//   Transform    clip[r] = ((m[r][0] x + m[r][1] y) + m[r][2] z) + m[r][3].
//   Dropped      In this order, each with its counter: an index out of range; a clip coordinate that is not finite.
//   Clip         Planes in the order  z >= 0,  z <= w,  x >= -Gx w,  x <= Gx w,  y >= -Gy w,  y <= Gy w  with Gx =
//                32767 / (W/2), Gy = 32767 / (H/2), one float32 division each. Signed distances: z;  w - z;  Gx w + x;
//                Gx w - x;  Gy w + y; Gy w - y. A vertex is inside when d >= 0. A plane that no vertex of the polygon
//                is outside of changes nothing; otherwise Sutherland-Hodgman from the polygon's first vertex: for each
//                edge (current, next) the current vertex is kept if inside, and if exactly one end is inside a new
//                vertex follows: from the inside end to the outside end  t = d_in / (d_in - d_out),  p = p_in + t
//                (p_out - p_in)  for x, y, z, w, and then the clipped coordinate is set exactly (z = 0;  z = w;  x =
//                -(Gx w);  x = Gx w;  likewise y). The polygon v0 v1 ... is fanned: (v0, v1, v2), (v0, v2, v3), ...
//   Project      r = 1/w. A piece with a vertex whose w is not > 0, whose r is not finite or whose snapped X or Y is
//                not within 2^24 either way (the guard band keeps them there, unless clipping overflowed float32) is
//                dropped and counted as behind. sx = (x r)(W/2) + W/2,  sy = (y r)(H/2) + H/2;  depth z r clamped: (z r
//                > 0) ? ((z r < 1) ? z r : 1) : +0.
//   Snap         With sub-pixel bits b, X = n 2^(8 - b) where n is sx * 2^b to the nearest integer, ties to even: n =
//                floor(s), d = s - n, n + 1 if d > 1/2 or d = 1/2 and n odd. With b = 0 positions go to the samples
//                themselves: s = sx - 0.5, X = 256 n + 128, so a triangle has integer vertices and its samples lie on
//                them. Likewise Y. X and Y are in 1/256 pixel whatever b is.
//   Orient       area2 = (X1 - X0)(Y2 - Y0) - (X2 - X0)(Y1 - Y0), exact. 0 is dropped. Negative is front
//                (counter-clockwise on the screen) and vertices 1 and 2 are swapped; what follows sees area2 > 0.
//   Cover        E_ab(p) = (Xb - Xa)(py - Ya) - (Yb - Ya)(px - Xa), exact, for the edges 0->1, 1->2, 2->0 at p = (256 i
//                + 128, 256 j + 128). Covered when each E > 0, or E = 0 on a top edge (Yb = Ya, Xb > Xa) or a left edge
//                (Yb < Ya); with fill=inclusive when each E >= 0.
//   Depth        r = 1 / float(area2);  d1 = z1 - z0;  d2 = z2 - z0;
//                zx = ((float(Y2 - Y0) * 256) * r) * d1 + ((float(Y0 - Y1) * 256) * r) * d2;
//                zy = ((float(X0 - X2) * 256) * r) * d1 + ((float(X1 - X0) * 256) * r) * d2;
//                rebased to the fixed 8 x 8 cell of the pixel: P the sample of pixel (i - i % 8, j - j % 8),
//                zc = z0 + ((float(E_20(P)) * r) * d1 + (float(E_01(P)) * r) * d2);
//                z = (zc + zx * float(i % 8)) + zy * float(j % 8);  float(int64) rounds once, to nearest even.
//                interpolate=plane has z = (z0 + zx * (float(px - X0) / 256)) + zy * (float(py - Y0) / 256) instead,
//                interpolate=weights z = z0 + ((float(E_20(p)) * r) * d1 + (float(E_01(p)) * r) * d2); each is
//                then kept within the piece: z = (z > zmin) ? z : zmin;  z = (z < zmax) ? z : zmax  over z0, z1, z2.
//                (So no sample is nearer than its piece's nearest vertex, which makes rejecting by zmin exact, and
//                slivers stay bounded.)
//   Visible      Smaller depth wins; at equal depth the lower id. An empty pixel has id 4294967295 and depth 1.0; 1.0
//                is drawn.
//   Attributes   Of the id's triangle v0 v1 v2 as it was before clipping and orientation, with values a0 a1 a2: A = (w0
//                a0 + w1 a1) + w2 a2, kept within a0, a1, a2 as depth within its piece. Where the three w are equal and
//                no vertex is outside a clip plane, linear on the screen, over the snapped X and Y: with E and area2 as
//                above, w0 = float(E_12(p)) / float(area2), w1 = float(E_20(p)) / float(area2), w2 = float(E_01(p)) /
//                float(area2). Elsewhere perspective-correct: px = ((i + 0.5) - W/2) / (W/2), py = ((j + 0.5) - H/2) /
//                (H/2), xk = xk - px wk, yk = yk - py wk of each vertex k; u0 = x1 y2 - x2 y1, u1 = x2 y0 - x0 y2, u2 =
//                x0 y1 - x1 y0, negated where (u0 + u1) + u2 < 0, then u = (u > 0) ? u : 0; wk = uk / ((u0 + u1) + u2),
//                or 1, 0, 0 where that sum is not > 0. A is NaN, 0x7fc00000, in an empty pixel and where one of a0, a1,
//                a2 is not finite.
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

/// What a frame counted, by name; counterDocs() lists the names and their meanings.
using Counters = std::map<std::string, std::uint64_t>;

/// How long a frame took, in nanoseconds of DeviceInfo::timeClock.
struct FrameTimes {
  std::uint64_t totalNs = 0;                                  ///< first dispatch to finished visibility buffer
  std::vector<std::pair<std::string, std::uint64_t>> stages;  ///< summed by stage, in pipeline order
};

/// What a stage wrote, in an order that does not depend on scheduling, so that two devices can be compared stage by
/// stage.
struct StageOutput {
  std::string stage;      ///< the stage's name
  std::string element;    ///< what one element is
  std::size_t words = 1;  ///< 32-bit words an element
  std::vector<std::uint32_t> values;  ///< `words` words an element
};

/// What render() gives.
struct Frame {
  Framebuffer image;                ///< empty where FrameOptions::readBack is false
  Counters counters;                ///< what was counted
  FrameTimes times;                 ///< how long it took
  Plan plan;                        ///< what ran, what was left out, why
  std::vector<StageOutput> stages;  ///< in pipeline order; only of frames that ran in one band and one batch
};

/// What a frame gives beside its counters and times.
struct FrameOptions {
  bool readBack = true;     ///< fill Frame::image
  bool countWork = false;   ///< also count tests, covered samples and atomics (slower kernels)
  bool keepStages = false;  ///< fill Frame::stages
};

/// Renders scenes on one device. Keeps kernels and buffers between frames.
/// Throws Error: kUnsupported for a variant that the device cannot run, kOverflow under overflow=error.
class Rasterizer {
 public:
  Rasterizer(Device& device, KernelCache& kernels);  ///< both have to outlive it
  ~Rasterizer();
  Rasterizer(const Rasterizer&) = delete;

  /// Renders the scene once. Axes that `variant` does not set are the plan's choice. Throws kUsage for axes that do not
  /// go together or with the scene; other codes as above.
  Frame render(const Scene& scene, const Variant& variant = {}, const FrameOptions& options = {});

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace tessera
