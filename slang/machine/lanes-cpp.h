// The lane types of lanes.slang in C++: each is one vector of kWidth elements. The host puts this text ahead of the C++
// text that slangc writes for a kernel that uses lanes.
//
// The arithmetic is written with the compiler's own vectors (GCC's and Clang's `vector_size`), so this one text serves
// AVX-512, AVX2, SSE4.1 and NEON. Intrinsics stand only where the compiler's vectors have no operation: masks in mask
// registers, compress, gather. Debian's Highway and std::experimental::simd have them all, but their headers add 0.7 s
// and 1.1 s to the compile of each kernel; <immintrin.h> adds 0.3 s, and is needed for AVX-512 only.
#include <cmath>
#include <cstdint>
#include <cstring>

// The host defines TESSERA_LANES where the axis `lane-width` asks for a width.
#ifndef TESSERA_LANES
#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
#define TESSERA_LANES 16
#elif defined(__AVX2__)
#define TESSERA_LANES 8
#else
#define TESSERA_LANES 4
#endif
#endif
#if TESSERA_LANES == 16 && defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
#define TESSERA_MASK_REGISTERS 1
#include <immintrin.h>
#else
#define TESSERA_MASK_REGISTERS 0
#endif

namespace tessera {

constexpr int kWidth = TESSERA_LANES;
constexpr int lanesAtOnce() { return kWidth; }

typedef int32_t IntVector __attribute__((vector_size(4 * kWidth)));
typedef uint32_t UintVector __attribute__((vector_size(4 * kWidth)));
typedef float FloatVector __attribute__((vector_size(4 * kWidth)));
// Half of the lanes each: a compiler takes a vector that is longer than the processor's apart, lane by lane.
typedef int32_t HalfInts __attribute__((vector_size(2 * kWidth)));
typedef float HalfFloats __attribute__((vector_size(2 * kWidth)));
typedef double HalfDoubles __attribute__((vector_size(4 * kWidth)));

struct Ints {
  IntVector v;
  Ints() = default;
  Ints(IntVector a) : v(a) {}
  explicit Ints(int a) : v(IntVector{} + a) {}
};
struct Floats {
  FloatVector v;
  Floats() = default;
  Floats(FloatVector a) : v(a) {}
  explicit Floats(float a) : v(FloatVector{} + a) {}
};
// 64-bit integers of a magnitude up to 2^53, kept as doubles: each sum and product in that range is exact.
struct Wides {
  HalfDoubles v[2];
};
union IntHalves {
  IntVector all;
  HalfInts half[2];
};
union FloatHalves {
  FloatVector all;
  HalfFloats half[2];
};

#if TESSERA_MASK_REGISTERS
struct Mask {
  __mmask16 m;
};
inline Mask operator&(Mask a, Mask b) { return {__mmask16(a.m & b.m)}; }
inline Mask operator|(Mask a, Mask b) { return {__mmask16(a.m | b.m)}; }
inline Mask operator!(Mask a) { return {__mmask16(~a.m)}; }
inline uint32_t maskBits(Mask a) { return a.m; }
inline Mask operator<(Ints a, Ints b) { return {_mm512_cmplt_epi32_mask(__m512i(a.v), __m512i(b.v))}; }
inline Mask operator<=(Ints a, Ints b) { return {_mm512_cmple_epi32_mask(__m512i(a.v), __m512i(b.v))}; }
inline Mask operator==(Ints a, Ints b) { return {_mm512_cmpeq_epi32_mask(__m512i(a.v), __m512i(b.v))}; }
inline Mask operator<(Floats a, Floats b) { return {_mm512_cmp_ps_mask(a.v, b.v, _CMP_LT_OQ)}; }
inline Mask operator<=(Floats a, Floats b) { return {_mm512_cmp_ps_mask(a.v, b.v, _CMP_LE_OQ)}; }
inline Mask operator==(Floats a, Floats b) { return {_mm512_cmp_ps_mask(a.v, b.v, _CMP_EQ_OQ)}; }
inline Mask negative(Ints a) { return {_mm512_movepi32_mask(__m512i(a.v))}; }
inline Ints select(Mask m, Ints a, Ints b) {
  return IntVector(_mm512_mask_blend_epi32(m.m, __m512i(b.v), __m512i(a.v)));
}
inline Floats select(Mask m, Floats a, Floats b) { return FloatVector(_mm512_mask_blend_ps(m.m, b.v, a.v)); }
#else
struct Mask {
  IntVector m;  // -1 where the lane is set, else 0
};
inline Mask operator&(Mask a, Mask b) { return {a.m & b.m}; }
inline Mask operator|(Mask a, Mask b) { return {a.m | b.m}; }
inline Mask operator!(Mask a) { return {~a.m}; }
inline Mask operator<(Ints a, Ints b) { return {a.v < b.v}; }
inline Mask operator<=(Ints a, Ints b) { return {a.v <= b.v}; }
inline Mask operator==(Ints a, Ints b) { return {a.v == b.v}; }
inline Mask operator<(Floats a, Floats b) { return {a.v < b.v}; }
inline Mask operator<=(Floats a, Floats b) { return {a.v <= b.v}; }
inline Mask operator==(Floats a, Floats b) { return {a.v == b.v}; }
inline Mask negative(Ints a) { return {a.v >> 31}; }
inline Ints select(Mask m, Ints a, Ints b) { return m.m ? a.v : b.v; }
inline Floats select(Mask m, Floats a, Floats b) { return m.m ? a.v : b.v; }
inline uint32_t maskBits(Mask a) {
  uint32_t bits = 0;
  for (int i = 0; i < kWidth; ++i) bits |= uint32_t(a.m[i] & 1) << i;
  return bits;
}
#endif

inline Ints operator+(Ints a, Ints b) { return IntVector(UintVector(a.v) + UintVector(b.v)); }
inline Ints operator-(Ints a, Ints b) { return IntVector(UintVector(a.v) - UintVector(b.v)); }
inline Ints operator*(Ints a, Ints b) { return IntVector(UintVector(a.v) * UintVector(b.v)); }
inline Ints operator&(Ints a, Ints b) { return a.v & b.v; }
inline Ints operator|(Ints a, Ints b) { return a.v | b.v; }
inline Ints operator<<(Ints a, int n) { return IntVector(UintVector(a.v) << uint32_t(n)); }
inline Ints operator>>(Ints a, int n) { return a.v >> n; }
inline Ints smaller(Ints a, Ints b) { return a.v < b.v ? a.v : b.v; }
inline Ints larger(Ints a, Ints b) { return a.v > b.v ? a.v : b.v; }

inline Floats operator+(Floats a, Floats b) { return a.v + b.v; }
inline Floats operator-(Floats a, Floats b) { return a.v - b.v; }
inline Floats operator*(Floats a, Floats b) { return a.v * b.v; }
inline Floats divide(Floats a, Floats b) { return a.v / b.v; }
// a where a < b, else b; and a where a > b, else b.
inline Floats smaller(Floats a, Floats b) { return a.v < b.v ? a.v : b.v; }
inline Floats larger(Floats a, Floats b) { return a.v > b.v ? a.v : b.v; }
inline Floats toFloats(Ints a) { return __builtin_convertvector(a.v, FloatVector); }
inline Ints ceiling(Floats a) {
  // Where `a` does not fit an int, the kernel asks for any int: the clamp makes it one, of a NaN, too.
  const FloatVector limit = FloatVector{} + 0x1p30f;
  const FloatVector below = a.v < limit ? a.v : limit, held = below > -limit ? below : -limit;
  const IntVector towardsZero = __builtin_convertvector(held, IntVector);
  return towardsZero - (__builtin_convertvector(towardsZero, FloatVector) < held);  // a comparison that holds is -1
}
inline Ints bitsOf(Floats a) { return IntVector(a.v); }
inline Floats fromBits(Ints a) { return FloatVector(a.v); }

inline Wides toWides(Ints a) {
  const IntHalves h{a.v};
  return {__builtin_convertvector(h.half[0], HalfDoubles), __builtin_convertvector(h.half[1], HalfDoubles)};
}
inline Wides operator*(Wides a, Wides b) { return {a.v[0] * b.v[0], a.v[1] * b.v[1]}; }
inline Wides operator+(Wides a, Wides b) { return {a.v[0] + b.v[0], a.v[1] + b.v[1]}; }
inline Wides operator-(Wides a, Wides b) { return {a.v[0] - b.v[0], a.v[1] - b.v[1]}; }
inline Wides product(Ints a, Ints b) { return toWides(a) * toWides(b); }
inline Floats toFloats(Wides a) {
  FloatHalves h;
  for (int i = 0; i < 2; ++i) h.half[i] = __builtin_convertvector(a.v[i], HalfFloats);
  return h.all;
}
inline HalfInts cellSteps(HalfDoubles a) {
  // Adding and taking away 1.5 * 2^52 rounds to the nearest integer: |a / 256| is below 2^51. Then one is taken away where
  // that was upwards.
  const HalfDoubles q = a * 0x1p-8, integers = HalfDoubles{} + 0x1.8p52, limit = HalfDoubles{} + 0x1p30;
  const HalfDoubles near = (q + integers) - integers;
  HalfDoubles floor = near > q ? near - 1.0 : near;
  floor = floor < limit ? floor : limit;
  floor = floor > -limit ? floor : -limit;
  return __builtin_convertvector(floor, HalfInts);
}
inline Ints cellSteps(Wides a) {
  IntHalves h;
  for (int i = 0; i < 2; ++i) h.half[i] = cellSteps(a.v[i]);
  return h.all;
}

alignas(64) constexpr int32_t kIndices[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
inline Ints laneIndices(int first) {
  IntVector a;
  std::memcpy(&a, kIndices, sizeof a);
  return a + first;
}
inline bool any(Mask a) { return maskBits(a) != 0; }
inline int count(Mask a) { return __builtin_popcount(maskBits(a)); }
inline int largest(Mask m, Ints a, int least) {
#if TESSERA_MASK_REGISTERS
  return _mm512_reduce_max_epi32(_mm512_mask_blend_epi32(m.m, _mm512_set1_epi32(least), __m512i(larger(a, Ints(least)).v)));
#else
  const Ints kept = select(m, a, Ints(least));
  int most = least;
  for (int i = 0; i < kWidth; ++i) most = kept.v[i] > most ? kept.v[i] : most;
  return most;
#endif
}

template <typename T> inline Ints loadInts(const T* p) {
  static_assert(sizeof(T) == 4);
  Ints a;
  std::memcpy(&a.v, p, sizeof a.v);
  return a;
}
inline Floats loadFloats(const float* p) {
  Floats a;
  std::memcpy(&a.v, p, sizeof a.v);
  return a;
}
template <typename T> inline void storeLanes(T* p, Ints a) {
  static_assert(sizeof(T) == 4);
  std::memcpy(p, &a.v, sizeof a.v);
}
inline void storeLanes(float* p, Floats a) { std::memcpy(p, &a.v, sizeof a.v); }
inline void storeLanes(double* p, Wides a) { std::memcpy(p, &a.v, sizeof a.v); }

template <typename T> inline Ints permute(const T* p, Ints at) {
  const IntVector a = loadInts(p).v;
#if TESSERA_MASK_REGISTERS
  return IntVector(_mm512_permutexvar_epi32(__m512i(at.v), __m512i(a)));
#elif defined(__clang__)
  IntVector moved;
  for (int i = 0; i < kWidth; ++i) moved[i] = a[at.v[i] & (kWidth - 1)];
  return moved;
#else
  return __builtin_shuffle(a, at.v);
#endif
}
inline Floats permute(const float* p, Ints at) { return FloatVector(permute(reinterpret_cast<const int32_t*>(p), at).v); }
inline Wides permute(const double* p, Ints at) {
  Wides a;
#if TESSERA_MASK_REGISTERS
  const __m512d low = _mm512_loadu_pd(p), high = _mm512_loadu_pd(p + 8);
  const IntHalves h{at.v};
  for (int i = 0; i < 2; ++i)
    a.v[i] = HalfDoubles(_mm512_permutex2var_pd(low, _mm512_cvtepi32_epi64(__m256i(h.half[i])), high));
#else
  for (int i = 0; i < kWidth; ++i) a.v[i / (kWidth / 2)][i % (kWidth / 2)] = p[at.v[i]];
#endif
  return a;
}
// Words of 64 bits: a lane's bits `high` above its bits `low`.
typedef uint64_t HalfWords __attribute__((vector_size(4 * kWidth)));
struct Words {
  HalfWords half[2];
};
inline Words wordsOf(Ints high, Ints low) {
#if TESSERA_MASK_REGISTERS
  const __m512i first = _mm512_setr_epi32(16, 0, 17, 1, 18, 2, 19, 3, 20, 4, 21, 5, 22, 6, 23, 7);
  const __m512i second = _mm512_add_epi32(first, _mm512_set1_epi32(8));
  return {HalfWords(_mm512_permutex2var_epi32(__m512i(high.v), first, __m512i(low.v))),
          HalfWords(_mm512_permutex2var_epi32(__m512i(high.v), second, __m512i(low.v)))};
#else
  typedef uint32_t HalfUints __attribute__((vector_size(2 * kWidth)));
  HalfUints above[2], below[2];
  std::memcpy(above, &high, sizeof high), std::memcpy(below, &low, sizeof low);
  Words words;
  for (int i = 0; i < 2; ++i)
    words.half[i] = __builtin_convertvector(above[i], HalfWords) << 32 | __builtin_convertvector(below[i], HalfWords);
  return words;
#endif
}
inline void minimum(uint64_t* words, Mask m, Ints high, Ints low) {
  const Words made = wordsOf(select(m, high, Ints(-1)), low);  // where m is not set a word above all others
  for (int i = 0; i < 2; ++i) {
    HalfWords held;
    std::memcpy(&held, words + i * (kWidth / 2), sizeof held);
    held = made.half[i] < held ? made.half[i] : held;
    std::memcpy(words + i * (kWidth / 2), &held, sizeof held);
  }
}
inline void minimumInto(uint64_t* words, Mask m, Ints at, Ints high, Ints low) {
  alignas(64) uint32_t place[kWidth];
  alignas(64) uint64_t word[kWidth];
  const Words made = wordsOf(high, low);
  std::memcpy(place, &at, sizeof at), std::memcpy(word, &made, sizeof made);
  for (uint32_t bits = maskBits(m); bits != 0; bits &= bits - 1) {
    const int i = __builtin_ctz(bits);
    uint64_t& held = words[place[i]];
    held = word[i] < held ? word[i] : held;
  }
}

template <typename T> inline Ints gather(const T* p, Ints at) {
  static_assert(sizeof(T) == 4);
#if TESSERA_MASK_REGISTERS
  return IntVector(_mm512_i32gather_epi32(__m512i(at.v), p, 4));
#else
  IntVector a;
  for (int i = 0; i < kWidth; ++i) a[i] = int32_t(p[at.v[i]]);
  return a;
#endif
}
inline Ints highWords(const uint64_t* p) {
#if TESSERA_MASK_REGISTERS
  const __m512i odd = _mm512_setr_epi32(1, 3, 5, 7, 9, 11, 13, 15, 17, 19, 21, 23, 25, 27, 29, 31);
  return IntVector(_mm512_permutex2var_epi32(_mm512_loadu_si512(p), odd, _mm512_loadu_si512(p + 8)));
#else
  IntVector a;
  for (int i = 0; i < kWidth; ++i) a[i] = int32_t(p[i] >> 32);
  return a;
#endif
}
inline Mask isSet(uint32_t low, uint32_t high, Ints bit) {
  const UintVector shift = UintVector(bit.v & 31);
  const IntVector word = IntVector((UintVector{} + low) >> shift & 1), upper = IntVector((UintVector{} + high) >> shift & 1);
  return !(select(bit < Ints(32), Ints(word), Ints(upper)) == Ints(0));
}
template <typename T> inline void addInto(T* word, Mask m, Ints a) {
  const IntVector kept = select(m, a, Ints(0)).v;
  for (int i = 0; i < kWidth; ++i) *word += T(kept[i]);
}
template <typename T> inline void maximumInto(T* word, Ints a) {
  const T most = T(largest(a == a, a, 0));
  *word = most > *word ? most : *word;
}
template <typename T> inline void setBits(T* words, Mask m, Ints bit) {
  for (uint32_t bits = maskBits(m); bits != 0; bits &= bits - 1) {
    const uint32_t at = uint32_t(bit.v[__builtin_ctz(bits)]);
    words[at >> 5] |= 1u << (at & 31);
  }
}
template <typename T> inline void prefetch(const T* p) {
  for (int line = 0; line < int(sizeof(T)); line += 64) __builtin_prefetch(reinterpret_cast<const char*>(p) + line);
  __builtin_prefetch(reinterpret_cast<const char*>(p + 1) - 1);
}

// Stores the lanes of `a` that are set in `m` one after another, from p on, and returns how many they are. The room behind p must
// take a whole vector.
template <typename T> inline int compress(T* p, Mask m, Ints a) {
#if TESSERA_MASK_REGISTERS
  _mm512_storeu_si512(p, _mm512_maskz_compress_epi32(m.m, __m512i(a.v)));
  return __builtin_popcount(m.m);
#else
  int n = 0;
  const uint32_t bits = maskBits(m);
  for (int i = 0; i < kWidth; ++i) {
    p[n] = T(a.v[i]);
    n += bits >> i & 1;
  }
  return n;
#endif
}

}  // namespace tessera
