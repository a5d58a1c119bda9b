#include "host/measure/render-error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/measure/parity-oracle.h"
#include "host/support/table.h"

namespace tessera::measure {
namespace {

bool approximates(const std::string& name, const std::string& value) {
  return !axis(name).values.empty() && axisValue(name, value).kind == AxisKind::kApproximate;
}

std::string oracleLine(const Run& run) {
  const Difference& d = *run.difference;
  std::string text = "error against the oracle, pixels: ";
  if (run.variant.get("commit") == "count")
    text += fmt::format("hits {}", support::grouped(d.hits));
  else
    text += fmt::format("coverage {}, ids {}, depth {} (at most {:.3g})", support::grouped(d.coverage),
                        support::grouped(d.id), support::grouped(d.depth), *d.depthMaxAbs);
  if (!d.id && run.wrongWinners)
    text += fmt::format(", wrong winners by colour {}", support::grouped(*run.wrongWinners));
  if (d.attribute) text += fmt::format(", values {}", support::grouped(d.attribute));
  if (isApproximate(run.variant) && d.colour)
    text += *d.colour == 0
                ? "; colours equal"
                : fmt::format("; colours {}, {:.2f} dB from exact ones", support::grouped(d.colour), *d.psnr);
  return text + '\n';
}

/// What errors of the attribute are relative to: the range that was asked for, else the span of the vertices' values.
ValueRange rangeOf(const Run& run) {
  if (run.attributeRange) return *run.attributeRange;
  ValueRange range{INFINITY, -INFINITY};
  for (const float value : run.scene->attribute()->values)
    if (std::isfinite(value)) range = {std::min(range.least, value), std::max(range.most, value)};
  return range;
}

std::string attributeLine(const Run& run) {
  const oracle::AttributeError& error = *run.attributeError;
  const std::string& name = run.scene->attribute()->name;
  if (error.pixels == 0) return fmt::format("attribute {}: no pixel has a value\n", name);
  const ValueRange range = rangeOf(run);
  const double span = std::abs(double{range.most} - range.least);
  std::string text = fmt::format("attribute {}: error at most {:.3g}, rms {:.3g}", name, error.max, error.rms);
  if (span > 0) text += fmt::format("; {:.3g} of the range {} to {}", error.max / span, range.least, range.most);
  return text + '\n';
}

}  // namespace

Variant exactVariant(const Variant& asked, const Variant& resolved) {
  Variant exact;
  for (const auto& [name, value] : asked.values())
    if (!approximates(name, value)) exact.set(name, value);
  exact.set("shade", resolved.get("shade"));
  return exact;
}

void measureAgainstOracle(Run& run, const Variant& asked, const Framebuffer& image, Rasterizer& rasterizer) {
  Oracle oracle(*run.scene, run.variant);
  if (!image.colour.empty() && isApproximate(run.variant))
    oracle.holdColours(rasterizer.render(*run.scene, exactVariant(asked, run.variant)).image.colour);
  run.difference = oracle.against(image);
  run.wrongWinners = wrongWinners(run.variant, *run.difference, oracle.expected(image), image);
}

Difference::Count wrongWinners(const Variant& resolved, const Difference& difference, const Framebuffer& expected,
                               const Framebuffer& image) {
  if (difference.id) return difference.id;
  const std::string commit = resolved.get("commit");
  const bool grey = commit == "depth24+lum8";
  if ((!grey && commit != "depth32+rgba8") || expected.colour.empty() || image.colour.empty()) return {};
  // As the heads of the commits' files have it: half a step of a channel, and roundings.
  const double bound = 0.5 / (grey ? 254 : 255) + 0x1p-20;
  std::uint64_t wrong = 0;
  for (std::size_t k = 0; k < image.pixels(); ++k) {
    glm::vec3 right = expected.colour[k];
    if (grey) right = glm::vec3((0.2126f * right.r + 0.7152f * right.g) + 0.0722f * right.b);  // Rec. 709
    bool differs = (expected.ids[k] == kNoTriangle) != (image.ids[k] == kNoTriangle);
    for (int channel = 0; channel < 3; ++channel)
      differs |= std::abs(static_cast<double>(image.colour[k][channel]) - static_cast<double>(right[channel])) > bound;
    wrong += differs;
  }
  return wrong;
}

std::string errorSummary(const Run& run) {
  std::string text;
  if (run.difference) text += oracleLine(run);
  if (run.hitCountNotOne) text += fmt::format("pixels hit, but not once: {}\n", support::grouped(*run.hitCountNotOne));
  if (run.attributeError) text += attributeLine(run);
  return text;
}

}  // namespace tessera::measure
