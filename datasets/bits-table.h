// Numbers things by their bits: equal bits get the number of the first one.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <utility>

#include "datasets/huge-pages.h"

namespace tessera::datasets {

/// Open addressing. A slot holds its key, so that a look into the table touches one place in memory.
template <class Word, std::size_t kWords>
class BitsTable {
 public:
  using Key = std::array<Word, kWords>;

  explicit BitsTable(std::size_t expected = 0)
      : size_(std::bit_ceil(expected / 3 * 4 + 1024)), slots_(zeros<Slot>(size_)) {}
  static std::uint64_t hash(const Key& key) {
    std::uint64_t hash = 0;
    for (const Word word : key) {
      hash = (hash ^ word) * 0x9e3779b97f4a7c15u;
      hash ^= hash >> 32;
    }
    return hash;
  }
  /// The slot will be needed soon.
  void prefetch(std::uint64_t hash) const { __builtin_prefetch(&slots_[hash & (size_ - 1)]); }
  /// The key's number; `fresh` where the key is new: its number is then how many there were.
  struct Found {
    std::uint32_t number;
    bool fresh;
  };
  Found add(const Key& key, std::uint64_t hash) {
    if (4 * std::uint64_t{count_} >= 3 * size_) grow();
    Slot& slot = slotOf(key, hash);
    if (slot.next != 0) return {slot.next - 1, false};
    slot = {key, ++count_};
    return {count_ - 1, true};
  }
  Found add(const Key& key) { return add(key, hash(key)); }

 private:
  struct Slot {
    Key key;
    std::uint32_t next;  ///< the number after the key's; 0 in an empty slot
  };
  static bool same(const Key& a, const Key& b) {  // the arrays' own == calls memcmp
    for (std::size_t i = 0; i < kWords; ++i)
      if (a[i] != b[i]) return false;
    return true;
  }
  /// The slot of the key: its own, or an empty one where it belongs.
  Slot& slotOf(const Key& key, std::uint64_t hash) {
    std::size_t at = hash & (size_ - 1);
    while (slots_[at].next != 0 && !same(slots_[at].key, key)) at = (at + 1) & (size_ - 1);
    return slots_[at];
  }
  void grow() {
    const std::size_t before = std::exchange(size_, 2 * size_);
    const auto narrow = std::exchange(slots_, zeros<Slot>(size_));
    for (std::size_t i = 0; i < before; ++i)
      if (narrow[i].next != 0) slotOf(narrow[i].key, hash(narrow[i].key)) = narrow[i];
  }

  std::size_t size_;  ///< slots, a power of two
  std::unique_ptr<Slot[], FreeMemory> slots_;
  std::uint32_t count_ = 0;  ///< keys
};

}  // namespace tessera::datasets
