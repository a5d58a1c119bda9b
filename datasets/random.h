// The random numbers of the generators and tests: the same on every machine, as the distributions of <random> are not.
#pragma once

#include <cstdint>

namespace tessera::datasets {

/// SplitMix64 (Steele, Lea and Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t bits() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  /// Uniform in [0, 1): 53 bits, so each value is exact.
  double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  /// Uniform in [least, most).
  double between(double least, double most) { return least + (most - least) * unit(); }

 private:
  std::uint64_t state_;
};

}  // namespace tessera::datasets
