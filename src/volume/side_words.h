#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "volume/band.h"

namespace lascaux {

/// For the 64 voxels of a block with one x, those whose neighbours at -x, +x, -y, +y, -z, +z are on
/// the other side of the surface.
///
/// A missing neighbour has no surface near, so it is on the same side as the voxels that touch it.
inline std::array<std::uint64_t, 6> CrossedSides(const Band& band, std::size_t block,
                                                 std::size_t x) {
  constexpr std::uint64_t kFirstZ = 0x0101010101010101;  // the bits with z = 0
  constexpr std::uint64_t kLastZ = kFirstZ << 7;
  const VoxelMask& own = band.inside[block];
  const std::uint64_t w = own[x];
  const auto beside = [&](std::size_t side) -> const VoxelMask* {
    const std::int32_t n = band.neighbours[block][side];
    return n == kNoBlock ? nullptr : &band.inside[static_cast<std::size_t>(n)];
  };
  const VoxelMask *const x0 = beside(0), *const x1 = beside(1), *const y0 = beside(2),
                         *const y1 = beside(3), *const z0 = beside(4), *const z1 = beside(5);
  const std::uint64_t low_x = x > 0 ? own[x - 1] : x0 != nullptr ? (*x0)[7] : w;
  const std::uint64_t high_x = x < 7 ? own[x + 1] : x1 != nullptr ? (*x1)[0] : w;
  const std::uint64_t low_y = w << 8 | (y0 != nullptr ? (*y0)[x] >> 56 : w & 0xFF);
  const std::uint64_t high_y = w >> 8 | (y1 != nullptr ? (*y1)[x] << 56 : w & 0xFFULL << 56);
  std::uint64_t first_z = w & kFirstZ;
  if (band.upper_half && band.origins[block].z() == 0) {
    first_z = w >> 1 & kFirstZ;
  } else if (z0 != nullptr) {
    first_z = (*z0)[x] >> 7 & kFirstZ;
  }
  const std::uint64_t last_z = z1 != nullptr ? (*z1)[x] << 7 & kLastZ : w & kLastZ;
  const std::uint64_t low_z = (w << 1 & ~kFirstZ) | first_z;
  const std::uint64_t high_z = (w >> 1 & ~kLastZ) | last_z;
  return {w ^ low_x, w ^ high_x, w ^ low_y, w ^ high_y, w ^ low_z, w ^ high_z};
}

}  // namespace lascaux
