// The oracle's numbers, and its edge function.
#pragma once

#include <tessera/oracle.h>

#include <cstdint>

namespace tessera::oracle {

__extension__ typedef __int128 Wide;  // products of edge functions stay below 2^60; 128 bits leave no bound to prove
#ifdef __SIZEOF_FLOAT128__
__extension__ typedef __float128 Exact;  // 113 bits
#else
using Exact = long double;  // binary128 where there is no __float128 (AArch64)
#endif

inline Wide sampleAt(std::int64_t pixel) { return Wide{256} * pixel + 128; }

/// E_ab(p) of the contract: positive to the right of a->b on the screen, which is inside.
inline Wide edge(const Piece& t, int a, int b, Wide px, Wide py) {
  return Wide{t.x[b] - t.x[a]} * (py - t.y[a]) - Wide{t.y[b] - t.y[a]} * (px - t.x[a]);
}

}  // namespace tessera::oracle
