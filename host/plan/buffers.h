// The list of the pipeline's buffers. A kernel binds a buffer by the buffer's name in this list, and a stream of the
// scene by the stream's name.
#pragma once

#include <tessera/framebuffer.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/plan/extent.h"

namespace tessera::plan {

/// The channel that a frame gets from a buffer that is read back.
struct ChannelDoc {
  ChannelType type;
  unsigned components;  ///< values for each pixel; 0: as many as the current stream has
  std::string element;  ///< what one pixel of the buffer holds, in words
  std::string empty;    ///< what a pixel holds where no triangle is, in words
};

/// One buffer of the pipeline.
struct BufferDoc {
  std::string name;     ///< the name in kernels
  std::uint32_t bytes;  ///< size of one element
  Extent extent;        ///< how many elements the buffer has
  std::optional<ChannelDoc> channel =
      {};  ///< the frame's channel of the buffer's name; nothing where the buffer stays on the device
};

/// All buffers of the pipeline.
const std::vector<BufferDoc>& buffers();
/// The buffer `name`. Null where no buffer has the name.
const BufferDoc* findBuffer(std::string_view name);
/// The buffer `name`. Throws kFailure with the name where no buffer has it.
const BufferDoc& bufferDoc(std::string_view name);
/// Whether the buffer has elements for the pixels of a band. The height of the band then decides the size of the
/// buffer.
bool isOfPixels(const BufferDoc& buffer);

}  // namespace tessera::plan
