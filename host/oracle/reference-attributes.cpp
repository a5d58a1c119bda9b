// The contract's section Attributes, in float32 and exactly.
#include <tessera/oracle.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>

#include "host/oracle/reference-clip.h"
#include "host/oracle/reference-exact.h"
#include "host/oracle/reference-project.h"

namespace tessera::oracle {
namespace {

const float kNoValue = std::bit_cast<float>(0x7fc00000u);

template <typename T>
using Three = std::array<T, 3>;

// Where one triangle lies, and from that the weights of its vertices at a pixel.
class Weights {
 public:
  Weights(const Scene& scene, const ImageAxes& axes, const std::vector<glm::vec4>& vertices, std::uint32_t id)
      : halfWidth_(static_cast<float>(scene.width) / 2), halfHeight_(static_cast<float>(scene.height) / 2) {
    for (int k = 0; k < 3; ++k) {
      clip_[k] = vertices[scene.triangles[id][k]];
    }
    const bool oneW = clip_[0].w == clip_[1].w && clip_[0].w == clip_[2].w;
    if (!oneW || clip(clip_, scene.width, scene.height).outsideSome) return;
    linear_.emplace(Piece{id, {}, {}, {}});
    for (int k = 0; k < 3; ++k) {
      const Snapped corner = project(clip_[k], scene, axes).value();
      linear_->x[k] = corner.x;
      linear_->y[k] = corner.y;
    }
  }

  Three<float> at(std::int64_t i, std::int64_t j) const { return linear_ ? onScreen(i, j) : homogeneous(i, j); }
  /// Not yet divided by their sum.
  Three<Exact> exactAt(std::int64_t i, std::int64_t j) const {
    return linear_ ? exactOnScreen(i, j) : exactHomogeneous(i, j);
  }

 private:
  Wide edgeAgainst(int k, std::int64_t i, std::int64_t j) const {
    return edge(*linear_, (k + 1) % 3, (k + 2) % 3, sampleAt(i), sampleAt(j));
  }

  Three<float> onScreen(std::int64_t i, std::int64_t j) const {
    const float area2 = static_cast<float>(edge(*linear_, 0, 1, linear_->x[2], linear_->y[2]));
    Three<float> w;
    for (int k = 0; k < 3; ++k) w[k] = static_cast<float>(edgeAgainst(k, i, j)) / area2;
    return w;
  }

  Three<Exact> exactOnScreen(std::int64_t i, std::int64_t j) const {
    Three<Exact> w;
    for (int k = 0; k < 3; ++k) w[k] = static_cast<Exact>(edgeAgainst(k, i, j));
    return w;
  }

  // Not yet divided by their sum; 1, 0, 0 where that is 0 or NaN.
  template <typename T>
  Three<T> weights(std::int64_t i, std::int64_t j) const {
    const T halfWidth = halfWidth_, halfHeight = halfHeight_, half = 0.5f;
    const T px = ((static_cast<T>(i) + half) - halfWidth) / halfWidth;
    const T py = ((static_cast<T>(j) + half) - halfHeight) / halfHeight;
    Three<T> x, y, u;
    for (int k = 0; k < 3; ++k) {
      x[k] = static_cast<T>(clip_[k].x) - px * static_cast<T>(clip_[k].w);
      y[k] = static_cast<T>(clip_[k].y) - py * static_cast<T>(clip_[k].w);
    }
    for (int k = 0; k < 3; ++k) {
      const int a = (k + 1) % 3, b = (k + 2) % 3;
      u[k] = x[a] * y[b] - x[b] * y[a];
    }
    const bool turned = (u[0] + u[1]) + u[2] < 0;
    for (T& w : u) {
      if (turned) w = -w;
      w = w > 0 ? w : T{0};
    }
    return (u[0] + u[1]) + u[2] > 0 ? u : Three<T>{T{1}, T{0}, T{0}};
  }

  Three<float> homogeneous(std::int64_t i, std::int64_t j) const {
    Three<float> w = weights<float>(i, j);
    const float sum = (w[0] + w[1]) + w[2];
    for (float& value : w) value = value / sum;
    return w;
  }

  Three<Exact> exactHomogeneous(std::int64_t i, std::int64_t j) const { return weights<Exact>(i, j); }

  float halfWidth_, halfHeight_;
  std::array<glm::vec4, 3> clip_{};
  std::optional<Piece> linear_;  // snapped, as its vertices come; nothing where weights are homogeneous
};

// One float of a stream at the vertices of a triangle.
Three<float> valuesOf(const Scene& scene, const Stream& stream, unsigned component, std::uint32_t id) {
  Three<float> values;
  for (int k = 0; k < 3; ++k)
    values[k] = stream.values[std::size_t{stream.components} * scene.triangles[id][k] + component];
  return values;
}

bool areFinite(const Three<float>& values) {
  return std::ranges::all_of(values, [](float a) { return std::isfinite(a); });
}

float weighed(const Three<float>& w, const Three<float>& value) {
  if (!areFinite(value)) return kNoValue;
  const float a = (w[0] * value[0] + w[1] * value[1]) + w[2] * value[2];
  const float least = *std::ranges::min_element(value), most = *std::ranges::max_element(value);
  const float atLeast = a > least ? a : least;
  return atLeast < most ? atLeast : most;
}

Exact exactlyWeighed(const Three<Exact>& w, const Three<float>& value) {
  return (w[0] * value[0] + w[1] * value[1] + w[2] * value[2]) / (w[0] + w[1] + w[2]);
}

// Calls use(k, id, weights, i, j) for each covered pixel k = (i, j).
template <typename Use>
void eachPixel(const Scene& scene, const ImageAxes& axes, const Framebuffer& frame, Use use) {
  const std::vector<glm::vec4> vertices = transform(scene);
  std::optional<Weights> weights;
  std::uint32_t id = kNoTriangle;
  for (std::size_t k = 0; k < frame.ids.size(); ++k) {
    if (frame.ids[k] >= scene.triangles.size()) continue;
    if (frame.ids[k] != id) weights.emplace(scene, axes, vertices, id = frame.ids[k]);
    use(k, id, *weights, static_cast<std::int64_t>(k % frame.width), static_cast<std::int64_t>(k / frame.width));
  }
}

}  // namespace

void interpolate(const Scene& scene, const ImageAxes& axes, Framebuffer& frame) {
  frame.channels.clear();
  for (const Stream* stream : interpolatedStreams(scene))
    frame.makeChannel(stream->name, ChannelType::kFloat32, stream->components)
        .floats()
        .assign(frame.ids.size() * stream->components, kNoValue);
  eachPixel(scene, axes, frame,
            [&](std::size_t k, std::uint32_t id, const Weights& weights, std::int64_t i, std::int64_t j) {
              const Three<float> w = weights.at(i, j);
              std::size_t at = 0;
              for (const Stream* stream : interpolatedStreams(scene)) {
                std::vector<float>& values = frame.channels[at++].floats();
                for (unsigned c = 0; c < stream->components; ++c)
                  values[k * stream->components + c] = weighed(w, valuesOf(scene, *stream, c, id));
              }
            });
}

AttributeError attributeError(const Scene& scene, const ImageAxes& axes, const Framebuffer& frame) {
  AttributeError error;
  double squares = 0;
  std::uint64_t count = 0;
  eachPixel(scene, axes, frame,
            [&](std::size_t k, std::uint32_t id, const Weights& weights, std::int64_t i, std::int64_t j) {
              const Three<Exact> w = weights.exactAt(i, j);
              bool measured = false;
              for (const Stream* stream : interpolatedStreams(scene))
                for (unsigned c = 0; c < stream->components; ++c) {
                  const Three<float> vertex = valuesOf(scene, *stream, c, id);
                  if (!areFinite(vertex)) continue;
                  const float value = frame.channel(stream->name)->floats()[k * stream->components + c];
                  double apart = std::abs(static_cast<double>(static_cast<Exact>(value) - exactlyWeighed(w, vertex)));
                  if (std::isnan(apart)) apart = std::numeric_limits<double>::infinity();
                  error.max = std::max(error.max, apart);
                  squares += apart * apart;
                  ++count;
                  measured = true;
                }
              error.pixels += measured;
            });
  if (count != 0) error.rms = std::sqrt(squares / static_cast<double>(count));
  return error;
}

}  // namespace tessera::oracle
