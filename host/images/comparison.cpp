#include "host/images/comparison.h"

#include <fmt/format.h>
#include <tessera/error.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

namespace tessera {
namespace {

enum class Part { kNone, kCoverage, kId, kDepth, kHits, kChannel, kColour };

// float32 numbers in order, -0 and +0 at 0: neighbours are 1 apart.
std::int64_t stepOf(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  const auto magnitude = static_cast<std::int64_t>(bits & 0x7fffffffu);
  return bits >> 31 ? -magnitude : magnitude;
}

double apart(float a, float b) { return std::abs(static_cast<double>(a) - static_cast<double>(b)); }
double stepsApart(float a, float b) { return static_cast<double>(std::abs(stepOf(a) - stepOf(b))); }

bool differ(float a, float b, const images::Amount& amount) {
  if (std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b)) return false;
  if (!amount.any()) return true;
  if (std::isnan(a) || std::isnan(b)) return !(std::isnan(a) && std::isnan(b));
  return !(apart(a, b) <= amount.absolute || (stepsApart(a, b) <= amount.steps && std::isfinite(a - b)));
}

// What both framebuffers hold, read pixel by pixel.
class Pair {
 public:
  Pair(const Framebuffer& a, const Framebuffer& b, const images::Tolerances& tolerances)
      : a_(a),
        b_(b),
        tolerances_(tolerances),
        ids_(both(a.ids, b.ids)),
        depth_(both(a.depth, b.depth)),
        hits_(both(a.hits, b.hits)),
        colour_(both(a.colour, b.colour)) {
    // Two images that have one channel each may call it differently.
    const bool alone = a.channels.size() == 1 && b.channels.size() == 1;
    for (const Channel& channel : a.channels) {
      const Channel* const other = alone ? b.channels.data() : b.channel(channel.name);
      if (other != nullptr && other->components == channel.components && other->type() == channel.type())
        channels_.push_back({channel, *other});
    }
    if (a.width != b.width || a.height != b.height) {
      failUsage(fmt::format("the images are {} x {} and {} x {} pixels; they should have one size", a.width, a.height,
                            b.width, b.height));
    }
    if (!ids_ && !depth_ && !hits_ && channels_.empty() && !colour_)
      failUsage("the images have no channel in common: nothing to compare");
  }

  bool hasCoverage() const { return ids_ || hits_; }
  bool hasIds() const { return ids_; }
  bool hasDepth() const { return depth_; }
  bool hasHits() const { return hits_; }
  bool hasColour() const { return colour_; }
  bool hasChannels() const { return !channels_.empty(); }
  bool idUnknown(std::size_t k) const {
    return ids_ && (a_.ids[k] == kUnknownTriangle || b_.ids[k] == kUnknownTriangle);
  }
  bool covered(std::size_t k) const { return ids_ ? a_.ids[k] != kNoTriangle : hits_ ? a_.hits[k] != 0 : true; }
  bool coverageDiffers(std::size_t k) const {
    if (ids_) return (a_.ids[k] == kNoTriangle) != (b_.ids[k] == kNoTriangle);
    return hits_ && (a_.hits[k] == 0) != (b_.hits[k] == 0);
  }
  bool idDiffers(std::size_t k) const {
    if (!ids_ || a_.ids[k] == b_.ids[k]) return false;
    return !idUnknown(k) || coverageDiffers(k);
  }
  bool depthDiffers(std::size_t k) const { return depth_ && differ(a_.depth[k], b_.depth[k], tolerances_.depth); }
  /// Calls use(x, y) for each pair of float32 values of a pixel.
  template <typename Use>
  void eachValue(std::size_t k, Use use) const {
    for (const auto& [a, b] : channels_)
      if (a.type() == ChannelType::kFloat32)
        for (std::size_t i = k * a.components; i < (k + 1) * a.components; ++i) use(a.floats()[i], b.floats()[i]);
  }
  bool channelsDiffer(std::size_t k) const {
    bool any = false;
    eachValue(k, [&](float x, float y) { any |= differ(x, y, tolerances_.attribute); });
    for (const auto& [a, b] : channels_)
      if (a.type() == ChannelType::kUint32)
        for (std::size_t i = k * a.components; i < (k + 1) * a.components; ++i)
          any |= std::get<1>(a.data)[i] != std::get<1>(b.data)[i];
    return any;
  }
  bool hitsDiffer(std::size_t k) const { return hits_ && a_.hits[k] != b_.hits[k]; }
  bool colourDiffers(std::size_t k) const {
    if (!colour_) return false;
    for (int c = 0; c < 3; ++c)
      if (differ(a_.colour[k][c], b_.colour[k][c], tolerances_.colour)) return true;
    return false;
  }

  /// The most telling difference of a pixel.
  Part part(std::size_t k) const {
    return coverageDiffers(k)  ? Part::kCoverage
           : idDiffers(k)      ? Part::kId
           : depthDiffers(k)   ? Part::kDepth
           : hitsDiffer(k)     ? Part::kHits
           : channelsDiffer(k) ? Part::kChannel
           : colourDiffers(k)  ? Part::kColour
                               : Part::kNone;
  }

 private:
  template <typename T>
  static bool both(const std::vector<T>& a, const std::vector<T>& b) {
    return !a.empty() && !b.empty();
  }
  const Framebuffer &a_, &b_;
  const images::Tolerances& tolerances_;
  bool ids_, depth_, hits_, colour_;
  struct Both {
    const Channel &a, &b;
  };
  std::vector<Both> channels_;  // of one name and one kind
};

double squaredDistance(const glm::vec3& a, const glm::vec3& b) {
  double sum = 0;
  for (int c = 0; c < 3; ++c) {
    const double d = static_cast<double>(a[c]) - static_cast<double>(b[c]);
    sum += d * d;
  }
  return sum;
}

Framebuffer onePixel(const Framebuffer& frame, std::size_t k) {
  Framebuffer pixel{.width = 1, .height = 1, .depth = {}, .ids = {}, .hits = {}, .colour = {}};
  const auto take = [&](auto& to, const auto& from) {
    if (!from.empty()) to.push_back(from[k]);
  };
  take(pixel.depth, frame.depth);
  take(pixel.ids, frame.ids);
  take(pixel.hits, frame.hits);
  take(pixel.colour, frame.colour);
  for (const Channel& from : frame.channels) {
    Channel& to = pixel.makeChannel(from.name, from.type(), from.components);
    std::visit(
        [&]<typename T>(const std::vector<T>& values) {
          const auto first = values.begin() + static_cast<std::ptrdiff_t>(k * from.components);
          to.data = std::vector<T>(first, first + from.components);
        },
        from.data);
  }
  return pixel;
}

// sRGB bytes to linear.
glm::vec3 linear(int r, int g, int b) {
  const auto channel = [](int v) {
    const float c = static_cast<float>(v) / 255;
    return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f);
  };
  return {channel(r), channel(g), channel(b)};
}

}  // namespace

namespace images {

struct Comparison::State {
  Tolerances tolerances;
  Difference sums;  // of what any rows held
  bool idsKnown = true;
  double squares = 0, attributeSquares = 0;
  std::uint64_t values = 0;  // of channels, that both have
  std::uint32_t rows = 0;
  Framebuffer firstA, firstB;

  // Both say how far they are apart, within the tolerances or not.
  void addDistances(const Pair& pair, const Framebuffer& a, const Framebuffer& b, std::size_t k) {
    if (pair.hasDepth() && !pair.coverageDiffers(k) && differ(a.depth[k], b.depth[k], {})) {
      const double distance = apart(a.depth[k], b.depth[k]);
      sums.depthMaxAbs =
          std::max(*sums.depthMaxAbs, std::isnan(distance) ? std::numeric_limits<double>::infinity() : distance);
      sums.depthMaxUlp = std::max(*sums.depthMaxUlp, stepsApart(a.depth[k], b.depth[k]));
    }
    pair.eachValue(k, [this](float x, float y) {
      if (std::isnan(x) || std::isnan(y)) return;
      const double distance = apart(x, y);
      sums.attributeMax = std::max(*sums.attributeMax, distance);
      attributeSquares += distance * distance;
      ++values;
    });
    if (pair.hasColour() && std::memcmp(&a.colour[k], &b.colour[k], sizeof(glm::vec3)) != 0) {
      squares += squaredDistance(a.colour[k], b.colour[k]);
      for (int c = 0; c < 3; ++c) {
        const double distance = apart(a.colour[k][c], b.colour[k][c]);
        sums.colourMax =
            std::max(*sums.colourMax, std::isnan(distance) ? std::numeric_limits<double>::infinity() : distance);
      }
    }
  }

  void begin(const Pair& pair) {
    const auto count = [](bool held) { return held ? Difference::Count(0) : Difference::Count(); };
    const auto most = [](bool held) { return held ? std::optional<double>(0) : std::optional<double>(); };
    sums.coverage = count(pair.hasCoverage());
    sums.id = count(pair.hasIds());
    sums.depth = count(pair.hasDepth());
    sums.hits = count(pair.hasHits());
    sums.attribute = count(pair.hasChannels());
    sums.colour = count(pair.hasColour());
    sums.depthMaxAbs = sums.depthMaxUlp = most(pair.hasDepth());
    sums.attributeMax = sums.attributeRms = most(pair.hasChannels());
    sums.colourMax = sums.psnr = most(pair.hasColour());
  }
};

Comparison::Comparison(const Tolerances& tolerances) : state_(std::make_unique<State>()) {
  state_->tolerances = tolerances;
}
Comparison::~Comparison() = default;
Comparison::Comparison(Comparison&&) noexcept = default;
const Framebuffer& Comparison::firstOfA() const { return state_->firstA; }
const Framebuffer& Comparison::firstOfB() const { return state_->firstB; }

void Comparison::add(const Framebuffer& a, const Framebuffer& b) {
  State& s = *state_;
  const Pair pair(a, b, s.tolerances);
  if (s.rows == 0) s.begin(pair);
  const auto add = [](Difference::Count& count, bool differs) {
    if (differs) ++*count;
  };
  for (std::size_t k = 0; k < a.pixels(); ++k) {
    s.idsKnown = s.idsKnown && !pair.idUnknown(k);
    s.addDistances(pair, a, b, k);
    if (pair.part(k) == Part::kNone) continue;
    add(s.sums.coverage, pair.coverageDiffers(k));
    add(s.sums.id, pair.idDiffers(k));
    add(s.sums.depth, pair.depthDiffers(k));
    add(s.sums.hits, pair.hitsDiffer(k));
    add(s.sums.attribute, pair.channelsDiffer(k));
    add(s.sums.colour, pair.colourDiffers(k));
    if (s.sums.anywhere++ != 0) continue;
    s.sums.firstX = static_cast<std::int64_t>(k % a.width);
    s.sums.firstY = static_cast<std::int64_t>(k / a.width) + s.rows;
    s.firstA = onePixel(a, k);
    s.firstB = onePixel(b, k);
  }
  s.sums.pixels += a.pixels();
  s.rows += a.height;
}

Difference Comparison::difference() const {
  const State& s = *state_;
  Difference result = s.sums;
  if (!s.idsKnown) result.id.reset();
  if (result.attributeRms && s.values != 0)
    result.attributeRms = std::sqrt(s.attributeSquares / static_cast<double>(s.values));
  if (result.psnr)
    result.psnr = -10 * std::log10(s.squares / (3 * static_cast<double>(result.pixels)));  // log10(0) is -infinity
  return result;
}

}  // namespace images

Difference compare(const Framebuffer& a, const Framebuffer& b) {
  images::Comparison comparison;
  comparison.add(a, b);
  return comparison.difference();
}

namespace images {

void paintDifference(const Framebuffer& a, const Framebuffer& b, std::uint32_t begin, std::uint32_t end, glm::vec3* out,
                     const Tolerances& tolerances) {
  // Colours that stay apart for colour-blind readers (M. Okabe, K. Ito: Color Universal Design, 2008).
  static const glm::vec3 vermilion = linear(213, 94, 0), blue = linear(0, 114, 178), yellow = linear(240, 228, 66),
                         purple = linear(204, 121, 167);
  static const glm::vec3 drawn = linear(190, 190, 190), empty = linear(230, 230, 230);
  const Pair pair(a, b, tolerances);
  for (std::size_t k = std::size_t{begin} * a.width; k < std::size_t{end} * a.width; ++k) {
    switch (pair.part(k)) {
      case Part::kNone:
        *out++ = pair.covered(k) ? drawn : empty;
        break;
      case Part::kCoverage:
        *out++ = vermilion;
        break;
      case Part::kId:
        *out++ = blue;
        break;
      case Part::kDepth:
        *out++ = yellow;
        break;
      case Part::kHits:
      case Part::kChannel:
      case Part::kColour:
        *out++ = purple;
        break;
    }
  }
}

}  // namespace images

std::vector<glm::vec3> differencePicture(const Framebuffer& a, const Framebuffer& b) {
  std::vector<glm::vec3> picture(a.pixels());
  images::paintDifference(a, b, 0, a.height, picture.data());
  return picture;
}

}  // namespace tessera
