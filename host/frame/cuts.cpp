#include "host/frame/cuts.h"

#include <fmt/format.h>
#include <tessera/error.h>

#include <algorithm>

#include "host/plan/buffers.h"

namespace tessera::frame {
namespace {

constexpr std::uint64_t kClippedPieces =
    26;  // that clipping makes of a triangle at most: slang's clip has kMaxCorners - 2
// Iterations of a lane of setup beside its walks over blocks: at most 28 corners at six planes, 78 projected.
constexpr std::uint64_t kSetupLoops = 1024;

/// Of the widest buffer of pixels that the plan's kernels bind.
std::uint64_t bytesOfPixel(const Scene& scene, const Dispatcher& dispatcher) {
  std::uint64_t widest = 4;
  for (const plan::BufferDoc& doc : plan::buffers())
    if (plan::isOfPixels(doc) && dispatcher.uses(doc.name)) {
      if (doc.extent == plan::Extent::kPixels) widest = std::max<std::uint64_t>(widest, doc.bytes);
      if (doc.extent == plan::Extent::kValues)
        for (const Stream* stream : interpolatedStreams(scene))
          widest = std::max<std::uint64_t>(widest, std::uint64_t{doc.bytes} * stream->components);
    }
  return widest;
}

}  // namespace

std::uint64_t loopsBeyond(std::uint64_t fixed, const DeviceInfo& device) {
  return device.maxLoopIterations > fixed ? device.maxLoopIterations - fixed : 0;
}

std::vector<Band> cutBands(const Scene& scene, const plan::Settings& settings, const Dispatcher& dispatcher) {
  const DeviceInfo& device = dispatcher.device().info();
  const std::uint64_t blocksAcross = plan::ceilDivide(scene.width, plan::kBlock);
  const std::uint64_t byBytes = device.maxBufferBytes / (bytesOfPixel(scene, dispatcher) * scene.width * plan::kBlock);
  // A lane walks twice over the blocks of each piece of its triangle. Each loop's last test counts as an iteration.
  // What is clipped and what is not follow one another in one subgroup.
  const std::uint64_t walks = 2 * (settings.clip ? kClippedPieces + 1 : 1);
  const std::uint64_t byLoops = loopsBeyond(kSetupLoops, device) / (walks * (blocksAcross + 2));
  const std::uint64_t rows =
      std::min<std::uint64_t>(std::max<std::uint64_t>(std::min(byBytes, byLoops), 1) * plan::kBlock, scene.height);
  std::vector<Band> bands;
  for (std::uint64_t begin = 0; begin < scene.height; begin += rows)
    bands.push_back({static_cast<std::uint32_t>(begin),
                     static_cast<std::uint32_t>(std::min<std::uint64_t>(begin + rows, scene.height))});
  return bands;
}

std::vector<Batch> halved(const std::vector<Batch>& batches, const DeviceInfo& device) {
  std::vector<Batch> halves;
  for (const Batch& b : batches) {
    if (b.count < 2)
      failUnsupported(fmt::format("{}: one triangle needs a buffer larger than its largest, {} bytes", device.name,
                                  device.maxBufferBytes));
    halves.push_back({b.first, b.count / 2});
    halves.push_back({b.first + b.count / 2, b.count - b.count / 2});
  }
  return halves;
}

}  // namespace tessera::frame
