// How two images differ, rows of both at a time, so that neither has to be in memory.
#pragma once

#include <tessera/image.h>

#include <cstdint>
#include <memory>

namespace tessera::images {

/// By how much two numbers may differ and still agree: by this or by so many float32 steps. Nothing: by no bit.
struct Amount {
  double absolute = 0, steps = 0;
  bool any() const { return absolute > 0 || steps > 0; }
};

/// Of the channels that hold numbers. A NaN agrees with NaNs alone; of a colour the channel counts that differs most.
struct Tolerances {
  Amount depth, attribute, colour;
  bool any() const { return depth.any() || attribute.any() || colour.any(); }
};

class Comparison {
 public:
  explicit Comparison(const Tolerances& tolerances = {});
  ~Comparison();
  Comparison(Comparison&&) noexcept;
  /// The next rows of both. Throws kUsage where they have another size, or nothing in common.
  void add(const Framebuffer& a, const Framebuffer& b);
  /// Of all rows so far, with counts of what is beyond the tolerances.
  Difference difference() const;
  /// Of both images the first pixel that differs, as frames of one pixel.
  const Framebuffer& firstOfA() const;
  const Framebuffer& firstOfB() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The rows of differencePicture() from `begin` up to `end`.
void paintDifference(const Framebuffer& a, const Framebuffer& b, std::uint32_t begin, std::uint32_t end, glm::vec3* out,
                     const Tolerances& tolerances = {});

}  // namespace tessera::images
