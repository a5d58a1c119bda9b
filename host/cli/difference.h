// How two images differ, in words.
#pragma once

#include <tessera/image.h>

#include <optional>
#include <string>

namespace tessera::cli {

/// A table of counts by kind, of bits and of what is beyond a tolerance, and the largest differences.
std::string describe(const Difference& bits, const std::optional<Difference>& beyond = {});

struct NamedFrame {
  const std::string& name;
  const Framebuffer& frame;
};
/// One line, of whole frames or of that pixel alone: the first differing pixel with both ids and depths (and their
/// bits).
std::string firstPixel(const Difference& difference, const NamedFrame& a, const NamedFrame& b);

}  // namespace tessera::cli
