// Loads libtessera-image-io.so when an image is read or written.
#pragma once

#include "host/images/image-io/image-io.h"

namespace tessera::images {

/// Throws kFailure with one line where it is missing or cannot be loaded. Thread-safe; loads once.
const images::Module& imageModule();

}  // namespace tessera::images
