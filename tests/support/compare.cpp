#include "compare.h"

#include <fmt/format.h>
#include <tessera/image.h>

#include <algorithm>
#include <bit>

namespace tessera::test {
namespace {

std::string pixelText(const Framebuffer& frame, std::size_t k) {
  std::string text;
  if (!frame.ids.empty()) text += fmt::format(" id {}", frame.ids[k]);
  if (!frame.depth.empty())
    text += fmt::format(" depth {} ({:#010x})", frame.depth[k], std::bit_cast<std::uint32_t>(frame.depth[k]));
  if (!frame.hits.empty()) text += fmt::format(" hits {}", frame.hits[k]);
  if (!frame.colour.empty())
    text += fmt::format(" colour {} {} {}", frame.colour[k].x, frame.colour[k].y, frame.colour[k].z);
  if (const auto values = frame.values(); !values.empty())
    text += fmt::format(" value {} ({:#010x})", values[k], std::bit_cast<std::uint32_t>(values[k]));
  return text;
}

}  // namespace

std::string difference(const Framebuffer& got, const Framebuffer& expected) {
  const Difference d = compare(got, expected);
  if (d.equal()) return "";
  const std::size_t k = static_cast<std::size_t>(d.firstY) * got.width + static_cast<std::size_t>(d.firstX);
  return fmt::format(
      "of {} pixels {} differ in id, {} in depth, {} in hits, {} in colour, {} in values; first ({}, {}):{}; "
      "expected{}",
      d.pixels, d.id.value_or(0), d.depth.value_or(0), d.hits.value_or(0), d.colour.value_or(0),
      d.attribute.value_or(0), d.firstX, d.firstY, pixelText(got, k), pixelText(expected, k));
}

std::string difference(const Counters& got, const oracle::Counts& expected) {
  const std::pair<const char*, std::uint64_t> counts[] = {
      {"submitted", expected.submitted}, {"badIndex", expected.badIndex}, {"nonFinite", expected.nonFinite},
      {"outside", expected.outside},     {"clipped", expected.clipped},   {"behind", expected.behind},
      {"zeroArea", expected.zeroArea},   {"facing", expected.facing}};
  for (const auto& [name, count] : counts)
    if (got.at(name) != count) return fmt::format("counter {} is {}; expected {}", name, got.at(name), count);
  return "";
}

std::string difference(const Frame& got, const oracle::Result& expected) {
  const std::string image = difference(got.image, expected.image);
  return image.empty() ? difference(got.counters, expected.counts) : image;
}

std::string difference(const std::vector<StageOutput>& got, const std::vector<StageOutput>& expected) {
  if (got.size() != expected.size()) return fmt::format("{} stage outputs; expected {}", got.size(), expected.size());
  for (std::size_t s = 0; s < got.size(); ++s) {
    const StageOutput &a = got[s], &b = expected[s];
    if (a.stage != b.stage || a.element != b.element)
      return fmt::format("stage {} ({}); expected {} ({})", a.stage, a.element, b.stage, b.element);
    if (a.values.size() != b.values.size())
      return fmt::format("stage {} ({}): {} words; expected {}", a.stage, a.element, a.values.size(), b.values.size());
    const auto [x, y] = std::ranges::mismatch(a.values, b.values);
    if (x == a.values.end()) continue;
    const auto word = static_cast<std::size_t>(x - a.values.begin());
    return fmt::format("stage {} ({}): element {} word {} is {:#010x}; expected {:#010x}", a.stage, a.element,
                       word / a.words, word % a.words, *x, *y);
  }
  return "";
}

}  // namespace tessera::test
