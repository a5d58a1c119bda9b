// The atomics of atomics.slang in C++. Stands ahead of the C++ text that slangc writes.
#include <sched.h>

#include <cstdint>

template <typename T, typename V> static inline T tesseraAtomicAdd(T* word, V value) {
  return __atomic_fetch_add(word, T(value), __ATOMIC_RELAXED);
}
template <typename T, typename V> static inline T tesseraAtomicOr(T* word, V value) {
  return __atomic_fetch_or(word, T(value), __ATOMIC_RELAXED);
}
template <typename T, typename V> static inline T tesseraAtomicExchange(T* word, V value) {
  return __atomic_exchange_n(word, T(value), __ATOMIC_RELAXED);
}
// x86 has no atomic min: a compare-exchange loop that ends as soon as the word is no longer to be lowered, so it is bounded by
// the number of values that other threads can write below this one's.
template <typename T, typename V> static inline T tesseraAtomicMin(T* word, V value) {
  T before = __atomic_load_n(word, __ATOMIC_RELAXED);
  while (T(value) < before &&
         !__atomic_compare_exchange_n(word, &before, T(value), true, __ATOMIC_RELAXED, __ATOMIC_RELAXED)) {}
  return before;
}
template <typename T, typename V> static inline T tesseraAtomicMax(T* word, V value) {
  T before = __atomic_load_n(word, __ATOMIC_RELAXED);
  while (before < T(value) &&
         !__atomic_compare_exchange_n(word, &before, T(value), true, __ATOMIC_RELAXED, __ATOMIC_RELAXED)) {}
  return before;
}
template <typename T, typename E, typename V> static inline T tesseraAtomicCompareExchange(T* word, E expected, V value) {
  T before = T(expected);
  __atomic_compare_exchange_n(word, &before, T(value), false, __ATOMIC_RELAXED, __ATOMIC_RELAXED);
  return before;
}

// Whoever holds the lock leaves it after two loads and two stores, so others wait for a bounded number of holders; a
// holder that the system has put aside is waited for without burning its core.
template <typename T> static inline void tesseraLock(T* word) {
  for (int tries = 1; __atomic_exchange_n(word, T(1), __ATOMIC_ACQUIRE) != 0; ++tries)
    if (tries % 64 == 0) sched_yield();
}
template <typename T> static inline void tesseraUnlock(T* word) { __atomic_store_n(word, T(0), __ATOMIC_RELEASE); }
