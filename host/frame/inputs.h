// What a scene gives the kernels: its arrays, and the uniforms that stay the same during a frame.
#pragma once

#include <tessera/scene.h>

#include "host/frame/dispatcher.h"

namespace tessera::frame {

/// Gives the scene to the kernels. Throws kUnsupported where the vertices do not fit the device's largest buffer.
void giveScene(Dispatcher& dispatcher, const Scene& scene);

/// The name of the buffer that holds a stream.
std::string bufferOf(const Stream& stream);
/// The name of the buffer that holds the values of an interpolated stream.
std::string valuesBufferOf(const Stream& stream);

}  // namespace tessera::frame
