#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include "volume/inline.h"

/// @file
/// Four numbers as a vector, in the notation that g++ and clang share: one register everywhere.

namespace lascaux {

using Four [[gnu::vector_size(16)]] = float;
using FourInts [[gnu::vector_size(16)]] = std::int32_t;  ///< of comparisons: -1 or 0

using FourDoubles [[gnu::vector_size(32)]] = double;

LASCAUX_INLINE Four Size(Four a) { return a < 0 ? -a : a; }

LASCAUX_INLINE Four Root(Four a) {
  for (std::size_t k = 0; k < 4; ++k) a[k] = std::sqrt(a[k]);
  return a;
}

LASCAUX_INLINE Four LoadFour(const float* from) {
  Four four;
  std::memcpy(&four, from, sizeof four);
  return four;
}

LASCAUX_INLINE void StoreFour(const Four& four, float* to) { std::memcpy(to, &four, sizeof four); }

/// Those of `a` where the mask is -1, 0 elsewhere.
LASCAUX_INLINE Four Where(const FourInts& mask, const Four& a) {
  FourInts bits;
  std::memcpy(&bits, &a, sizeof bits);
  bits &= mask;
  Four masked;
  std::memcpy(&masked, &bits, sizeof masked);
  return masked;
}

/// Is each of the four -1?
LASCAUX_INLINE bool AreAll(const FourInts& mask) {
#if defined(__SSE2__)
  __m128 bits;
  std::memcpy(&bits, &mask, sizeof bits);
  return _mm_movemask_ps(bits) == 0xF;
#else
  return (mask[0] & mask[1] & mask[2] & mask[3]) != 0;
#endif
}

/// Four points by their coordinates.
struct FourPoints {
  Four x, y, z;
};

/// Two floats from each of two places.
LASCAUX_INLINE Four TwoAndTwo(const float* a, const float* b) {
  using Pairs [[gnu::vector_size(16)]] = double;  // by halves, each of two floats
  std::array<double, 2> pairs;
  std::memcpy(&pairs[0], a, sizeof(double));
  std::memcpy(&pairs[1], b, sizeof(double));
  const Pairs both = {pairs[0], pairs[1]};
  Four four;
  std::memcpy(&four, &both, sizeof four);
  return four;
}

/// `T` is float or const float.
template <typename T>
LASCAUX_INLINE FourPoints Gather(const std::array<T*, 4>& at) {
  const Four low = TwoAndTwo(at[0], at[1]), high = TwoAndTwo(at[2], at[3]);
  return {__builtin_shufflevector(low, high, 0, 2, 4, 6),
          __builtin_shufflevector(low, high, 1, 3, 5, 7),
          Four{at[0][2], at[1][2], at[2][2], at[3][2]}};
}

/// Stores four points.
LASCAUX_INLINE void Scatter(const FourPoints& points, const std::array<float*, 4>& to) {
  const Four xy_low = __builtin_shufflevector(points.x, points.y, 0, 4, 1, 5);
  const Four xy_high = __builtin_shufflevector(points.x, points.y, 2, 6, 3, 7);
  const std::array<Four, 4> rows = {__builtin_shufflevector(xy_low, points.z, 0, 1, 4, 4),
                                    __builtin_shufflevector(xy_low, points.z, 2, 3, 5, 5),
                                    __builtin_shufflevector(xy_high, points.z, 0, 1, 6, 6),
                                    __builtin_shufflevector(xy_high, points.z, 2, 3, 7, 7)};
  for (std::size_t i = 0; i < 4; ++i) std::memcpy(to[i], &rows[i], 3 * sizeof(float));
}

}  // namespace lascaux
