#include "datasets/faces.h"

#include <fmt/format.h>
#include <tessera/error.h>

namespace tessera::datasets {

void Faces::add(std::span<const std::uint32_t> corners) {
  auto& triangles = mesh_.triangles;
  if (corners.size() < 3) {
    ++short_;
    return;
  }
  if (corners.size() > 3)
    polygons_.push_back({static_cast<std::uint32_t>(triangles.size()), static_cast<std::uint32_t>(corners.size() - 2)});
  if (triangles.size() + corners.size() >= kBadIndex)
    failUsage(fmt::format("more than {} triangles: ids reach no further", kBadIndex - 1));
  for (std::size_t i = 2; i < corners.size(); ++i) triangles.push_back({corners[0], corners[i - 1], corners[i]});
}

void Faces::finish() {
  for (const auto& [first, count] : polygons_)
    mesh_.concavePolygons += cutConcave(mesh_.positions, std::span(mesh_.triangles).subspan(first, count));
  const auto some = [](std::uint64_t count, const char* one, const char* many) {
    return fmt::format("{} {}", count, count == 1 ? one : many);
  };
  if (mesh_.concavePolygons != 0)
    mesh_.notes.push_back(
        fmt::format("{} not convex: cut into triangles by ear clipping, in the plane of the Newell normal",
                    some(mesh_.concavePolygons, "polygon is", "polygons are")));
  if (short_ != 0)
    mesh_.notes.push_back(
        fmt::format("{} fewer than three corners and no triangle", some(short_, "face has", "faces have")));
}

}  // namespace tessera::datasets
