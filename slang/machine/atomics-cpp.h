// The atomics of atomics.slang in C++. The host puts this text ahead of the C++ text that slangc writes.
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
// x86 has no atomic minimum, so this is a loop of compare-exchanges. The loop ends as soon as the word is not above
// `value`. A compare-exchange fails only if another thread wrote to the word in between. So the number of iterations is
// at most one more than the number of values above `value` that other threads write meanwhile. The maximum below is
// alike.
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

// A thread that holds the lock gives it back after two loads and two stores, so a thread that waits does so for a
// bounded number of holders. The system may have stopped the thread that holds the lock; a waiting thread therefore
// yields its core now and then.
template <typename T> static inline void tesseraLock(T* word) {
  for (int tries = 1; __atomic_exchange_n(word, T(1), __ATOMIC_ACQUIRE) != 0; ++tries)
    if (tries % 64 == 0) sched_yield();
}
template <typename T> static inline void tesseraUnlock(T* word) { __atomic_store_n(word, T(0), __ATOMIC_RELEASE); }
