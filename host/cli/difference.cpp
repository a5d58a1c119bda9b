#include "host/cli/difference.h"

#include <fmt/format.h>

#include <bit>

#include "host/cli/table.h"

namespace tessera::cli {
namespace {

std::string pixelText(const NamedFrame& named, std::size_t at) {
  const Framebuffer& frame = named.frame;
  std::string text = named.name + ":";
  if (!frame.ids.empty())
    text += frame.ids[at] == kNoTriangle        ? " no triangle"
            : frame.ids[at] == kUnknownTriangle ? " unknown id"
                                                : fmt::format(" id {}", frame.ids[at]);
  if (!frame.depth.empty())
    text += fmt::format(" depth {} (0x{:08x})", frame.depth[at], std::bit_cast<std::uint32_t>(frame.depth[at]));
  if (!frame.hits.empty()) text += fmt::format(" hits {}", frame.hits[at]);
  if (!frame.attribute.empty())
    text += fmt::format(" value {} (0x{:08x})", frame.attribute[at], std::bit_cast<std::uint32_t>(frame.attribute[at]));
  if (!frame.colour.empty())
    text += fmt::format(" colour {} {} {}", frame.colour[at].r, frame.colour[at].g, frame.colour[at].b);
  return text;
}

}  // namespace

std::string describe(const Difference& difference) {
  std::string text = table(
      {{"pixels", "coverage", "id", "depth", "hits", "values", "colour"},
       {grouped(difference.pixels), grouped(difference.coverage), grouped(difference.id), grouped(difference.depth),
        grouped(difference.hits), grouped(difference.attribute), grouped(difference.colour)}});
  if (difference.depth.value_or(0) != 0)
    text += fmt::format("largest depth difference {} ({} float32 steps)\n", *difference.depthMaxAbs,
                        *difference.depthMaxUlp);
  if (difference.attribute.value_or(0) != 0)
    text += fmt::format("largest difference of the values {}, rms {}\n", *difference.attributeMax,
                        *difference.attributeRms);
  if (difference.colour.value_or(0) != 0) text += fmt::format("PSNR of the colours {:.2f} dB\n", *difference.psnr);
  return text + (difference.equal() ? "equal\n" : "different\n");
}

std::string firstPixel(const Difference& difference, const NamedFrame& a, const NamedFrame& b) {
  const auto at =
      static_cast<std::size_t>(difference.firstY) * a.frame.width + static_cast<std::size_t>(difference.firstX);
  return fmt::format("first difference at pixel ({}, {}); {}; {}", difference.firstX, difference.firstY,
                     pixelText(a, at), pixelText(b, at));
}

}  // namespace tessera::cli
