// A framebuffer as 8-bit sRGB for people to look at.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "host/framebuffer.h"

namespace tessera {

struct Picture {
  int channels = 4;                  ///< 3: R G B; 4: and alpha, 0 where nothing was drawn
  std::vector<std::uint8_t> pixels;  ///< row-major, interleaved
};

/// The colour if there is any; else the attribute, over `range` or over what this frame holds; else a heat map of the
/// hits; else the depth in grey; of these whatever the frame has. Empty if it has none.
Picture makePicture(const Framebuffer& frame, const std::optional<ValueRange>& range = {});

}  // namespace tessera
