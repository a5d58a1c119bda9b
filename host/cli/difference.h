// How two images differ, in words.
#pragma once

#include <string>

#include "host/image.h"

namespace tessera::cli {

/// A table of counts by kind.
std::string describe(const Difference& difference);

struct NamedFrame {
  const std::string& name;
  const Framebuffer& frame;
};
/// One line: the first differing pixel with both ids and depths (and their bits).
std::string firstPixel(const Difference& difference, const NamedFrame& a, const NamedFrame& b);

}  // namespace tessera::cli
