#include "host/cli/reduce.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <numeric>

namespace tessera::cli {
namespace {

using Clock = std::chrono::steady_clock;
using Triangles = std::vector<std::uint32_t>;

class Reducer {
 public:
  Reducer(const Scene& scene, const std::function<bool(const Scene&)>& differs, double seconds,
          const std::function<void(std::size_t)>& progress)
      : scene_(scene),
        differs_(differs),
        progress_(progress),
        end_(Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds))) {}

  Reduced run(const std::vector<Triangles>& suspects) {
    Triangles left(scene_.triangles.size());
    std::iota(left.begin(), left.end(), 0u);
    for (const Triangles& set : suspects)
      if (set.size() < left.size() && shows(set)) {
        left = set;
        break;
      }
    const bool least = ddmin(left);
    return {withTriangles(scene_, left), tests_, least};
  }

 private:
  bool timeIsUp() const { return Clock::now() >= end_; }

  bool shows(const Triangles& triangles) {
    ++tests_;
    return differs_(withTriangles(scene_, triangles));
  }

  /// One of `parts` pieces of a list, or all but that one.
  static Triangles cut(const Triangles& all, std::size_t parts, std::size_t part, bool rest) {
    const auto begin = static_cast<std::ptrdiff_t>(all.size() * part / parts),
               end = static_cast<std::ptrdiff_t>(all.size() * (part + 1) / parts);
    if (!rest) return {all.begin() + begin, all.begin() + end};
    Triangles kept(all.begin(), all.begin() + begin);
    kept.insert(kept.end(), all.begin() + end, all.end());
    return kept;
  }

  /// True when no triangle can be left out.
  bool ddmin(Triangles& left) {
    std::size_t parts = 2;
    while (left.size() > 1) {
      progress_(left.size());
      bool smaller = false;
      for (const bool rest : {false, true}) {
        if (rest && parts == 2) continue;  // the other half, which was tried
        for (std::size_t part = 0; part < parts && !smaller; ++part) {
          if (timeIsUp()) return false;
          Triangles some = cut(left, parts, part, rest);
          if (!shows(some)) continue;
          left = std::move(some);
          parts = rest ? std::max<std::size_t>(parts - 1, 2) : 2;
          smaller = true;
        }
      }
      if (smaller) continue;
      if (parts == left.size()) return true;
      parts = std::min(2 * parts, left.size());
    }
    return true;
  }

  const Scene& scene_;
  const std::function<bool(const Scene&)>& differs_;
  const std::function<void(std::size_t)>& progress_;
  const Clock::time_point end_;
  std::size_t tests_ = 0;
};

}  // namespace

Scene withTriangles(const Scene& scene, const Triangles& triangles) {
  Scene some;
  some.name = scene.name;
  some.width = scene.width;
  some.height = scene.height;
  for (const Stream& stream : scene.streams) some.makeStream(stream.name, stream.components, stream.interpolated);
  std::map<std::uint32_t, std::uint32_t> vertices;  // of the scene -> of this one
  for (const std::uint32_t t : triangles) {
    Triangle corners = scene.triangles[t];
    for (auto& corner : corners) {
      if (corner >= scene.clip.size()) continue;  // out of range stays out of range
      const auto [place, isNew] = vertices.try_emplace(corner, static_cast<std::uint32_t>(some.clip.size()));
      if (isNew) some.clip.push_back(scene.clip[corner]);
      for (std::size_t s = 0; isNew && s < scene.streams.size(); ++s)
        for (unsigned c = 0; c < scene.streams[s].components; ++c)
          some.streams[s].values.push_back(scene.streams[s].values[corner * scene.streams[s].components + c]);
      corner = place->second;
    }
    some.triangles.push_back(corners);
  }
  return some;
}

Reduced reduceTriangles(const Scene& scene, const std::vector<Triangles>& suspects,
                        const std::function<bool(const Scene&)>& differs, double seconds,
                        const std::function<void(std::size_t)>& progress) {
  return Reducer(scene, differs, seconds, progress).run(suspects);
}

}  // namespace tessera::cli
