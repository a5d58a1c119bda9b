// A framebuffer as 8-bit sRGB for people to look at.
#pragma once

#include <tessera/framebuffer.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>

namespace tessera::images {

/// Made as it is written, so that there is never a second image in memory.
struct Picture {
  int channels = 0;  ///< 0: of nothing; 3: R G B; 4: and alpha, 0 where nothing was drawn
  /// Those from `first` up to `last`, interleaved.
  std::function<void(std::size_t first, std::size_t last, std::uint8_t* out)> pixels;
};

/// The colour if there is any; else the attribute, over `range` or over what this frame holds; else a heat map of the
/// hits; else the depth in grey; of these whatever the frame has. Looks at `frame` when pixels are asked for.
Picture makePicture(const Framebuffer& frame, const std::optional<ValueRange>& range = {});
/// One linear colour as three bytes of sRGB; what follows them in `out`.
std::uint8_t* putSrgb(const glm::vec3& linear, std::uint8_t* out);

}  // namespace tessera::images
