// Numbers things by their bits: equal bits get the number of the first one.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "datasets/huge-pages.h"

namespace tessera {

/// Open addressing. A slot has a number and some bits of the key's hash, so that other keys are seldom looked at.
template <class Word, std::size_t kWords>
class BitsTable {
 public:
  using Key = std::array<Word, kWords>;

  explicit BitsTable(std::size_t expected = 0) {
    resizeHuge(slots_, std::bit_ceil(expected / 3 * 4 + 1024), kEmpty);
    reserveHuge(keys_, expected);
  }
  static std::uint64_t hash(const Key& key) {
    std::uint64_t hash = 0;
    for (const Word word : key) {
      hash = (hash ^ word) * 0x9e3779b97f4a7c15u;
      hash ^= hash >> 32;
    }
    return hash;
  }
  /// The slot will be needed soon.
  void prefetch(std::uint64_t hash) const { __builtin_prefetch(&slots_[hash & (slots_.size() - 1)]); }
  /// The key's number; `fresh` where the key is new: its number is then how many there were.
  struct Found {
    std::uint32_t number;
    bool fresh;
  };
  Found add(const Key& key, std::uint64_t hash) {
    if (4 * keys_.size() >= 3 * slots_.size()) grow();
    std::size_t at = hash & (slots_.size() - 1);
    const std::uint64_t tag = hash & kTag;
    for (; slots_[at] != kEmpty; at = (at + 1) & (slots_.size() - 1))
      if ((slots_[at] & kTag) == tag && same(keys_[slots_[at] & ~kTag], key))
        return {static_cast<std::uint32_t>(slots_[at]), false};
    const auto number = static_cast<std::uint32_t>(keys_.size());
    slots_[at] = tag | number;
    keys_.push_back(key);
    return {number, true};
  }
  Found add(const Key& key) { return add(key, hash(key)); }

 private:
  static bool same(const Key& a, const Key& b) {  // the arrays' own == calls memcmp
    for (std::size_t i = 0; i < kWords; ++i)
      if (a[i] != b[i]) return false;
    return true;
  }
  static constexpr std::uint64_t kEmpty = ~std::uint64_t{0}, kTag = ~std::uint64_t{0xffffffff};

  void grow() {
    std::vector<std::uint64_t> wider;
    resizeHuge(wider, 2 * slots_.size(), kEmpty);
    for (std::uint32_t i = 0; i < keys_.size(); ++i) {
      const std::uint64_t h = hash(keys_[i]);
      std::size_t at = h & (wider.size() - 1);
      while (wider[at] != kEmpty) at = (at + 1) & (wider.size() - 1);
      wider[at] = (h & kTag) | i;
    }
    slots_ = std::move(wider);
  }

  std::vector<std::uint64_t> slots_;  ///< a power of two
  std::vector<Key> keys_;             ///< by number
};

}  // namespace tessera
