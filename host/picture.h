// A framebuffer as 8-bit sRGB for people to look at.
#pragma once

#include <cstdint>
#include <vector>

#include "host/framebuffer.h"

namespace tessera {

struct Picture {
  int channels = 4;                  ///< 3: R G B; 4: and alpha, 0 where nothing was drawn
  std::vector<std::uint8_t> pixels;  ///< row-major, interleaved
};

/// The colour if there is any; else a heat map of the hits if there are any; else the depth in grey. Empty if there is
/// none.
Picture makePicture(const Framebuffer& frame);

}  // namespace tessera
