#include "host/frame/outputs.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <span>
#include <type_traits>
#include <variant>

#include "host/frame/inputs.h"
#include "host/plan/buffers.h"

namespace tessera::frame {
namespace {

constexpr std::size_t kPieceWords = 10;  // slang's layout: Piece

/// `size`: elements of the whole raster.
template <typename T>
void append(std::vector<T>& whole, Dispatcher& d, std::string_view buffer, std::size_t elements, std::size_t size) {
  const std::vector<T> rows = d.read<T>(buffer, elements);
  if (whole.empty() && elements < size) whole.reserve(size);
  whole.insert(whole.end(), rows.begin(), rows.end());
}

void keep(std::vector<StageOutput>& stages, std::string stage, std::string element, std::size_t words,
          std::vector<std::uint32_t> values) {
  stages.push_back({std::move(stage), std::move(element), words, std::move(values)});
}

}  // namespace

void readBand(Dispatcher& d, const Scene& scene, Framebuffer& image) {
  const std::size_t pixels = d.count(plan::Extent::kPixels);
  const auto intoChannel = [&](Channel& channel, std::string_view buffer) {
    const unsigned components = channel.components;
    std::visit([&](auto& whole) { append(whole, d, buffer, components * pixels, components * image.pixels()); },
               channel.data);
  };
  for (const plan::BufferDoc& doc : plan::buffers()) {
    if (!doc.channel || !d.uses(doc.name)) continue;
    if (doc.extent == plan::Extent::kValues) {
      for (const Stream* stream : interpolatedStreams(scene))
        intoChannel(image.makeChannel(stream->name, doc.channel->type, stream->components), valuesBufferOf(*stream));
      continue;
    }
    std::visit(
        [&]<typename Member>(Member member) {
          if constexpr (std::is_same_v<Member, std::monostate>)
            intoChannel(image.makeChannel(doc.name, doc.channel->type, doc.channel->components), doc.name);
          else
            append(*member, d, doc.name, pixels, image.pixels());
        },
        image.member(doc.name));
  }
}

void keepSetup(Dispatcher& d, const Scene& scene, const plan::Settings& settings, std::vector<StageOutput>& stages) {
  keep(stages, "transform", "vertex, clip x y z w", 4, d.read<std::uint32_t>("clipSpace", 4 * scene.vertexCount()));
  const std::size_t slots = d.get("slotCount");
  auto pieces = d.read<std::uint32_t>("pieces", kPieceWords * slots);
  // An empty slot holds its id and nothing else. The further pieces of a triangle, and all pieces where slots are
  // compact, are in the order in which lanes came; here they are sorted.
  const std::size_t placed = settings.compact ? 0 : d.get("triangleCount");
  std::vector<std::array<std::uint32_t, kPieceWords>> unplaced;
  for (std::size_t i = 0; i < slots; ++i) {
    const auto piece = std::span(pieces).subspan(kPieceWords * i, kPieceWords);
    if (piece[kPieceWords - 1] == kNoTriangle) std::ranges::fill(piece, kNoTriangle);
    if (i >= placed) std::ranges::copy(piece, unplaced.emplace_back().begin());
  }
  std::ranges::sort(unplaced);
  if (!unplaced.empty())
    std::memcpy(pieces.data() + kPieceWords * placed, unplaced.data(), 4 * kPieceWords * unplaced.size());
  keep(stages, "setup", "piece, x0 y0 x1 y1 x2 y2 z0 z1 z2 id", kPieceWords, std::move(pieces));
}

void keepFrame(Dispatcher& d, const Scene& scene, const Bins& bins, std::vector<StageOutput>& stages) {
  if (d.uses("hits")) return;
  const std::size_t pixels = d.count(plan::Extent::kPixels);
  if (bins.listed())
    keep(stages, "bin", "tile, pieces", 1, d.read<std::uint32_t>("tileCounts", d.count(plan::Extent::kTiles)));
  keep(stages, "raster", "pixel, depth", 1, d.read<std::uint32_t>("depth", pixels));
  keep(stages, "raster", "pixel, id", 1, d.read<std::uint32_t>("ids", pixels));
  for (const Stream* stream : interpolatedStreams(scene))
    keep(stages, "attribute", "pixel, value", stream->components,
         d.read<std::uint32_t>(valuesBufferOf(*stream), stream->components * pixels));
}

}  // namespace tessera::frame
