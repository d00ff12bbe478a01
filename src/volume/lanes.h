#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include "volume/inline.h"

/// @file
/// Lines of eight voxels as vectors, in the notation that g++ and clang share: one register with
/// AVX2, two without. All of it is inlined, so that sources may compile it for several instruction
/// sets.

namespace lascaux {

inline constexpr std::size_t kLanes = 8;
using Lanes [[gnu::vector_size(4 * kLanes)]] = float;
using LaneMask [[gnu::vector_size(4 * kLanes)]] = std::int32_t;  ///< of comparisons: -1 or 0

LASCAUX_INLINE Lanes All(float value) { return Lanes{} + value; }

LASCAUX_INLINE Lanes Load(const float* from) {
  Lanes lanes;
  std::memcpy(&lanes, from, sizeof lanes);
  return lanes;
}

LASCAUX_INLINE void Store(const Lanes& lanes, float* to) { std::memcpy(to, &lanes, sizeof lanes); }

LASCAUX_INLINE Lanes Min(const Lanes& a, const Lanes& b) { return a < b ? a : b; }
LASCAUX_INLINE Lanes Max(const Lanes& a, const Lanes& b) { return a < b ? b : a; }

/// Square root of what is positive, 0 of the rest.
LASCAUX_INLINE Lanes Root(Lanes a) {
  a = Max(a, Lanes{});
  for (std::size_t k = 0; k < kLanes; ++k) a[k] = std::sqrt(a[k]);
  return a;
}

/// Bit k of lane k.
LASCAUX_INLINE std::uint64_t BitsOf(const LaneMask& mask) {
#if defined(__SSE2__)
  __m128 halves[2];
  std::memcpy(halves, &mask, sizeof mask);
  return static_cast<std::uint64_t>(_mm_movemask_ps(halves[0]) | _mm_movemask_ps(halves[1]) << 4);
#else
  std::uint64_t bits = 0;
  for (std::size_t k = 0; k < kLanes; ++k) bits |= static_cast<std::uint64_t>(mask[k] & 1) << k;
  return bits;
#endif
}

/// The lanes whose bits are set, of the lowest eight.
LASCAUX_INLINE LaneMask LanesIn(std::uint64_t bits) {
  return (LaneMask{1, 2, 4, 8, 16, 32, 64, 128} & static_cast<std::int32_t>(bits)) != 0;
}

/// Line, one step up or down, with `end` where nothing is left.
LASCAUX_INLINE Lanes Before(const Lanes& line, float end) {
  return __builtin_shufflevector(line, All(end), 8, 0, 1, 2, 3, 4, 5, 6);
}
LASCAUX_INLINE Lanes After(const Lanes& line, float end) {
  return __builtin_shufflevector(line, All(end), 1, 2, 3, 4, 5, 6, 7, 8);
}

}  // namespace lascaux
