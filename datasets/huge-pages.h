// Memory that is about to be filled for the first time. A page fault for each 4 KiB costs more than reading a binary
// mesh; with huge pages, where the system has them, there is one for 2 MiB.
#pragma once

#include <sys/mman.h>

#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>
#include <type_traits>
#include <vector>

namespace tessera::datasets {

/// Asks for huge pages where whole ones lie in the range; without them nothing changes but the time.
inline void preferHugePages(void* begin, std::size_t bytes) {
  constexpr std::uintptr_t kHuge = 2 << 20, kPage = 4096;
  const auto first = (reinterpret_cast<std::uintptr_t>(begin) + kPage - 1) / kPage * kPage;
  const auto end = (reinterpret_cast<std::uintptr_t>(begin) + bytes) / kPage * kPage;
  if (bytes >= 2 * kHuge && end > first) madvise(reinterpret_cast<void*>(first), end - first, MADV_HUGEPAGE);
}

template <class T>
void reserveHuge(std::vector<T>& values, std::size_t count) {
  values.reserve(count);
  preferHugePages(values.data(), values.capacity() * sizeof(T));
}
template <class T>
void resizeHuge(std::vector<T>& values, std::size_t count, const T& value = {}) {
  reserveHuge(values, count);
  values.resize(count, value);
}

struct FreeMemory {
  void operator()(void* memory) const { std::free(memory); }
};
/// Memory of zeros, which the system has ready: nothing is written here. Throws std::bad_alloc.
template <class T>
std::unique_ptr<T[], FreeMemory> zeros(std::size_t count) {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);
  auto* const memory = static_cast<T*>(std::calloc(count, sizeof(T)));
  if (!memory) throw std::bad_alloc();
  preferHugePages(memory, count * sizeof(T));
  return std::unique_ptr<T[], FreeMemory>(memory);
}

}  // namespace tessera::datasets
