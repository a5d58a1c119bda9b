#include "random-scene.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "datasets/random.h"

namespace tessera::test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

class Maker {
 public:
  explicit Maker(std::uint64_t seed) : random_(seed * 0x9e3779b97f4a7c15u + 1) {
    scene_.name = fmt::format("random scene {}", seed);
  }

  Scene make() {
    chooseScene();
    const std::size_t count = 1 + below(chance(0.2) ? 300 : 80);
    while (scene_.triangles.size() < count) addTriangle();
    if (chance(0.125)) spoil();
    if (object_) toObjectSpace();
    return std::move(scene_);
  }

 private:
  bool chance(double p) { return random_.unit() < p; }
  std::uint32_t below(std::uint64_t n) { return static_cast<std::uint32_t>(random_.bits() % n); }
  double around(double centre, double radius) { return random_.between(centre - radius, centre + radius); }

  // ---- the scene's own draws

  std::uint32_t extent() {
    if (powerOfTwo_) return 1u << below(9);
    return chance(0.1) ? 1 : 1 + below(chance(0.5) ? 256 : 100);
  }

  void chooseScene() {
    powerOfTwo_ = chance(0.5);
    scene_.width = extent();
    scene_.height = extent();
    wKind_ = below(4);
    zKind_ = below(4);
    object_ = wKind_ < 3 && chance(0.25);
    const double largest = std::max(scene_.width, scene_.height);
    size_ = std::exp2(random_.between(-4, std::log2(largest) + 1));  // pixels
  }

  float chooseW() {
    if (chance(0.02)) return 0.0f;
    const double sign = chance(0.05) ? -1 : 1;
    switch (wKind_) {
      case 0:
        return 1.0f;
      case 1:
        return static_cast<float>(sign * std::exp2(double(below(9)) - 4));
      case 2:
        return static_cast<float>(sign * std::exp2(random_.between(-20, 20)));
      default:
        return static_cast<float>(sign * std::exp2(chance(0.5) ? random_.between(-4, 4) : random_.between(-149, 127)));
    }
  }

  double chooseZ() {  // z / w
    switch (zKind_) {
      case 0:
        return random_.unit();
      case 1:
        return below(9) / 8.0;
      case 2:
        return chance(0.1) ? around(0.5, 2) : below(3) / 2.0;
      default:
        return around(0.5, 0.75);
    }
  }

  // ---- vertices: pixels from the top left corner

  struct Point {
    double x, y;
  };

  Point near(Point centre) {
    const double radius = chance(0.1) ? size_ * 8 : size_;
    const Point p{around(centre.x, radius), around(centre.y, radius)};
    switch (below(8)) {
      case 0:
        return {std::floor(p.x) + 0.5, std::floor(p.y) + 0.5};
      case 1:
        return {std::floor(p.x), std::floor(p.y)};
      case 2:
        return {std::floor(p.x * 256) / 256, std::floor(p.y * 256) / 256};
      case 3:
        return {(std::floor(p.x * 256) + 0.5) / 256, (std::floor(p.y * 256) + 0.5) / 256};
      case 4:
        return chance(0.5) ? Point{std::floor(p.x) + 0.5, p.y} : Point{p.x, std::floor(p.y) + 0.5};
      default:
        return p;
    }
  }

  Point farOut() {
    const auto side = [&](double extent) {
      const double guard = (chance(0.5) ? -1 : 1) * 32767.0;
      switch (below(4)) {
        case 0:
          return around(extent / 2, extent);
        case 1:
          return extent / 2 + guard + (chance(0.5) ? 0 : around(0, 2));
        case 2:
          return extent / 2 + around(0, 40000);
        default:
          return around(0, 1) * std::exp2(random_.between(10, 40));
      }
    };
    return {side(scene_.width), side(scene_.height)};
  }

  std::uint32_t addVertex(Point p, double depth, float w) {
    const double halfWidth = scene_.width / 2.0, halfHeight = scene_.height / 2.0;
    // Where w is 0 the point is a direction.
    const double scale = w == 0 ? 1 : w;
    scene_.clip.emplace_back(static_cast<float>((p.x - halfWidth) / halfWidth * scale),
                             static_cast<float>((p.y - halfHeight) / halfHeight * scale),
                             static_cast<float>(depth * scale), w);
    points_.push_back(p);
    return static_cast<std::uint32_t>(scene_.clip.size() - 1);
  }

  std::uint32_t newVertex(Point centre) {
    return addVertex(chance(0.04) ? farOut() : near(centre), chooseZ(), chooseW());
  }

  /// On the edge of an earlier triangle, a simple fraction along it.
  std::uint32_t vertexOnEdge() {
    const Triangle& t = earlier();
    const std::uint32_t corner = below(3);
    const Point a = points_[t[corner]], b = points_[t[(corner + 1) % 3]];
    const double part = below(5) / 4.0;
    return addVertex({a.x + part * (b.x - a.x), a.y + part * (b.y - a.y)}, chooseZ(), chooseW());
  }

  // ---- triangles

  const Triangle& earlier() { return scene_.triangles[below(scene_.triangles.size())]; }
  Point onScreen() {
    return {around(scene_.width / 2.0, scene_.width * 0.55), around(scene_.height / 2.0, scene_.height * 0.55)};
  }

  void addTriangle() {
    const Point centre = onScreen();
    const auto anyVertex = [&] { return below(scene_.clip.size()); };
    switch (scene_.triangles.empty() ? 0 : below(10)) {
      case 0:
      case 1:
      case 2:
      case 3:
        scene_.triangles.push_back({newVertex(centre), newVertex(centre), newVertex(centre)});
        break;
      case 4:
        scene_.triangles.push_back({anyVertex(), anyVertex(), anyVertex()});
        break;
      case 5:
      case 6: {  // across an edge of an earlier one
        const Triangle t = earlier();
        const std::uint32_t corner = below(3), a = t[corner], b = t[(corner + 1) % 3];
        scene_.triangles.push_back({b, a, newVertex(points_[a])});
        break;
      }
      case 7: {
        const Triangle t = earlier();
        scene_.triangles.push_back(chance(0.5) ? t : Triangle{t[2], t[1], t[0]});
        break;
      }
      case 8:
        scene_.triangles.push_back({vertexOnEdge(), vertexOnEdge(), newVertex(centre)});
        break;
      default: {
        const std::uint32_t a = anyVertex();
        scene_.triangles.push_back(chance(0.5) ? Triangle{a, a, newVertex(centre)}
                                               : Triangle{a, newVertex(centre), newVertex(points_[a])});
      }
    }
  }

  void spoil() {
    for (int i = 0; i < 3; ++i) {
      const float value = chance(0.5) ? kNaN : chance(0.5) ? kInfinity : -kInfinity;
      scene_.clip[below(scene_.clip.size())][static_cast<int>(below(4))] = value;
      const std::uint32_t beyond = static_cast<std::uint32_t>(scene_.clip.size()) + (chance(0.5) ? 0 : below(1u << 31));
      scene_.triangles[below(scene_.triangles.size())][below(3)] = chance(0.1) ? 0xffffffffu : beyond;
    }
  }

  /// The same picture, roughly, through a matrix: w is 1 everywhere, or a linear function of z.
  void toObjectSpace() {
    const bool perspective = chance(0.5);
    const float slope = perspective ? static_cast<float>(random_.between(0.5, 4)) : 0.0f;
    for (const glm::vec4& c : scene_.clip) scene_.positions.emplace_back(c.x / 1.25f, c.y * 0.75f, c.z);
    scene_.clip.clear();
    scene_.clipFromObject = {1.25f, 0, 0, 0, 0, 1.0f / 0.75f, 0, 0, 0, 0, 1, 0, 0, 0, slope, 1};
  }

  datasets::Random random_;
  Scene scene_;
  std::vector<Point> points_;  // of each vertex, as it was meant
  bool powerOfTwo_ = false, object_ = false;
  std::uint32_t wKind_ = 0, zKind_ = 0;
  double size_ = 1;
};

}  // namespace

Scene randomScene(std::uint64_t seed) { return Maker(seed).make(); }

Variant randomImage(std::uint64_t seed) {
  Variant image;
  for (const char* const name : {"cull", "fill", "sub-pixel", "interpolate"}) {
    const auto& values = axis(name).values;
    image.set(name, values[seed % kImages % values.size()].name);
  }
  return image;
}

}  // namespace tessera::test
