// The list of the pipeline's buffers: a kernel binds a buffer by its name here, or a stream of the scene by the
// stream's.
#pragma once

#include <tessera/framebuffer.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/plan/extent.h"

namespace tessera {

/// What a frame gets of a buffer that is read back.
struct ChannelDoc {
  ChannelType type;
  unsigned components;  ///< 0: as many as the stream in hand has
  std::string element;  ///< what one pixel of the buffer holds, in words
  std::string empty;    ///< what it holds where no triangle is
};

struct BufferDoc {
  std::string name;     ///< as kernels call it
  std::uint32_t bytes;  ///< of one element of `extent`
  Extent extent;
  std::optional<ChannelDoc> channel =
      {};  ///< the frame's channel of the buffer's name; nothing: it stays on the device
};

const std::vector<BufferDoc>& buffers();
/// Nothing where no buffer has the name.
const BufferDoc* findBuffer(std::string_view name);
/// Throws kFailure with the name where no buffer has it.
const BufferDoc& bufferDoc(std::string_view name);
/// Whether the buffer has elements for the pixels of a band, so that the height of a band decides its size.
bool isOfPixels(const BufferDoc& buffer);

}  // namespace tessera
