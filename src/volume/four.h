#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <cstring>

/// @file
/// Four numbers as a vector, in the notation that g++ and clang share: one register everywhere.

#define LASCAUX_INLINE [[gnu::always_inline]] inline

namespace lascaux {

using Four [[gnu::vector_size(16)]] = float;
using FourInts [[gnu::vector_size(16)]] = std::int32_t;  ///< of comparisons: -1 or 0

LASCAUX_INLINE Four Size(Four a) { return a < 0 ? -a : a; }

/// Those of `a` where the mask is -1, 0 elsewhere.
LASCAUX_INLINE Four Where(const FourInts& mask, const Four& a) {
  FourInts bits;
  std::memcpy(&bits, &a, sizeof bits);
  bits &= mask;
  Four masked;
  std::memcpy(&masked, &bits, sizeof masked);
  return masked;
}

/// Four points by their coordinates.
struct FourPoints {
  Four x, y, z;
};

/// Points from whose addresses four numbers can be read.
LASCAUX_INLINE FourPoints Gather(const std::array<const float*, 4>& at) {
  std::array<Four, 4> p;
  for (std::size_t i = 0; i < 4; ++i) std::memcpy(&p[i], at[i], sizeof p[i]);
  const Four xy_low = __builtin_shufflevector(p[0], p[1], 0, 4, 1, 5);
  const Four xy_high = __builtin_shufflevector(p[2], p[3], 0, 4, 1, 5);
  const Four z_low = __builtin_shufflevector(p[0], p[1], 2, 6, 2, 6);
  const Four z_high = __builtin_shufflevector(p[2], p[3], 2, 6, 2, 6);
  return {__builtin_shufflevector(xy_low, xy_high, 0, 1, 4, 5),
          __builtin_shufflevector(xy_low, xy_high, 2, 3, 6, 7),
          __builtin_shufflevector(z_low, z_high, 0, 1, 4, 5)};
}

/// Stores the first `count` of four points.
LASCAUX_INLINE void Store(const FourPoints& points, std::size_t count, Eigen::Vector3f* to) {
  const Four xy_low = __builtin_shufflevector(points.x, points.y, 0, 4, 1, 5);
  const Four xy_high = __builtin_shufflevector(points.x, points.y, 2, 6, 3, 7);
  const std::array<Four, 4> rows = {__builtin_shufflevector(xy_low, points.z, 0, 1, 4, 4),
                                    __builtin_shufflevector(xy_low, points.z, 2, 3, 5, 5),
                                    __builtin_shufflevector(xy_high, points.z, 0, 1, 6, 6),
                                    __builtin_shufflevector(xy_high, points.z, 2, 3, 7, 7)};
  for (std::size_t i = 0; i < count; ++i)
    std::memcpy(to[i].data(), &rows[i], sizeof(Eigen::Vector3f));
}

}  // namespace lascaux
