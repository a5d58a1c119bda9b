#include "host/cli/difference.h"

#include <fmt/format.h>

#include <array>
#include <bit>

#include "host/support/table.h"

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
  for (const Channel& channel : frame.channels)
    for (unsigned c = 0; c < channel.components; ++c)
      std::visit(
          [&](const auto& values) {
            const auto value = values[at * channel.components + c];
            text += fmt::format(" value {} (0x{:08x})", value, std::bit_cast<std::uint32_t>(value));
          },
          channel.data);
  if (!frame.colour.empty())
    text += fmt::format(" colour {} {} {}", frame.colour[at].r, frame.colour[at].g, frame.colour[at].b);
  return text;
}

}  // namespace

std::string describe(const Difference& bits, const std::optional<Difference>& beyond) {
  const auto counts = [](const Difference& d) {
    return std::vector<std::string>{
        support::grouped(d.pixels), support::grouped(d.coverage),  support::grouped(d.id),    support::grouped(d.depth),
        support::grouped(d.hits),   support::grouped(d.attribute), support::grouped(d.colour)};
  };
  std::vector<std::vector<std::string>> rows{{"pixels", "coverage", "id", "depth", "hits", "values", "colour"},
                                             counts(bits)};
  if (beyond) {
    rows.push_back(counts(*beyond));
    const std::array<const char*, 3> names{"", "other bits", "beyond tolerance"};
    for (std::size_t k = 0; k < rows.size(); ++k) rows[k].insert(rows[k].begin(), names[k]);
  }
  std::string text = support::table(rows);
  if (bits.depth.value_or(0) != 0)
    text += fmt::format("largest depth difference {} ({} float32 steps)\n", *bits.depthMaxAbs, *bits.depthMaxUlp);
  if (bits.attribute.value_or(0) != 0)
    text += fmt::format("largest difference of the values {}, rms {}\n", *bits.attributeMax, *bits.attributeRms);
  if (bits.colour.value_or(0) != 0)
    text += fmt::format("largest difference of the colours {}, PSNR {:.2f} dB\n", *bits.colourMax, *bits.psnr);
  return text;
}

std::string firstPixel(const Difference& difference, const NamedFrame& a, const NamedFrame& b) {
  // A frame of one pixel is the one that differs.
  const std::size_t at = a.frame.pixels() == 1 ? 0
                                               : static_cast<std::size_t>(difference.firstY) * a.frame.width +
                                                     static_cast<std::size_t>(difference.firstX);
  return fmt::format("first difference at pixel ({}, {}); {}; {}", difference.firstX, difference.firstY,
                     pixelText(a, at), pixelText(b, at));
}

}  // namespace tessera::cli
