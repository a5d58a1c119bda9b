#include "host/measure/parity-oracle.h"

#include <fmt/format.h>
#include <tessera/oracle.h>

#include <algorithm>

#include "host/oracle/oracle-image.h"

namespace tessera::measure {
Oracle::Oracle(const Scene& scene, const Variant& variant)
    : image_(oracle::render(scene, oracle::imageAxesOf(variant)).image) {}

Difference Oracle::against(const Framebuffer& frame) const { return compare(expected(frame), frame); }

Framebuffer Oracle::expected(const Framebuffer& frame) const {
  Framebuffer image;
  image.width = image_.width;
  image.height = image_.height;
  if (!frame.depth.empty()) image.depth = image_.depth;
  if (!frame.ids.empty()) image.ids = image_.ids;
  if (!frame.hits.empty()) image.hits = image_.hits;
  if (!frame.colour.empty()) image.colour = image_.colour;
  if (!frame.channels.empty()) image.channels = image_.channels;
  return image;
}

std::string firstStage(const Frame& good, const std::string& goodName, const Frame& frame, const std::string& name) {
  for (const auto& output : frame.stages) {
    const auto same = [&](const StageOutput& other) {
      return other.stage == output.stage && other.element == output.element;
    };
    const auto expected = std::find_if(good.stages.begin(), good.stages.end(), same);
    if (expected == good.stages.end()) continue;
    const auto& a = expected->values;
    const auto& b = output.values;
    const auto [left, right] = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
    if (left == a.end() && right == b.end()) continue;
    const auto at = static_cast<std::size_t>(left - a.begin());
    const auto word = [at](const std::vector<std::uint32_t>& values) {
      return at < values.size() ? fmt::format("0x{:08x}", values[at]) : std::string("nothing");
    };
    const std::size_t comma =
        output.element.find(", ");  // "vertex, clip x y z w": what one is, then what its words are
    const std::string words = comma == std::string::npos ? "" : fmt::format(" ({})", output.element.substr(comma + 2));
    return fmt::format("first stage that differs: {}, {} {}{}, word {}: {} on {}, {} on {}", output.stage,
                       output.element.substr(0, comma), at / output.words, words, at % output.words, word(a), goodName,
                       word(b), name);
  }
  return "no stage output differs: the images part after the last one, or the frames ran in several parts";
}

}  // namespace tessera::measure
