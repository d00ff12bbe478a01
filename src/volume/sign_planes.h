#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "volume/surface_cells.h"

namespace lascaux {

/// Which voxels are inside at 64 cells' lower corners, all with one x, and at those one step along
/// y, z and both.
struct SignPlanes {
  std::uint64_t at, y, z, yz;
};

/// Signs of a block's voxels and of those one step beyond.
class SignsAround {
 public:
  SignsAround(const SurfaceCells& cells, std::size_t block) {
    static constexpr VoxelMask kNoVoxels{};
    static constexpr VoxelMask kAllVoxels = [] {
      VoxelMask mask{};
      for (std::uint64_t& word : mask) word = ~std::uint64_t{0};
      return mask;
    }();
    for (std::size_t side = 0; side < 8; ++side) {
      const std::int32_t n = cells.above[block][side];
      if (n != kNoBlock) {
        masks_[side] = &cells.inside[static_cast<std::size_t>(n)];
      } else {
        // A missing block is on the side of the voxels that it would touch.
        const std::size_t x = side % 2 == 1 ? 7 : 0;
        const std::size_t bit = (side / 2 % 2 == 1 ? 56 : 0) + (side / 4 == 1 ? 7 : 0);
        const bool is_inside = (cells.inside[block][x] >> bit & 1) != 0;
        masks_[side] = is_inside ? &kAllVoxels : &kNoVoxels;
      }
    }
  }

  /// Plane x of the block, 0 to 8.
  SignPlanes At(std::size_t x) const {
    constexpr std::uint64_t kLastZ = 0x8080808080808080;  // the bits with z = 7
    const std::size_t beyond = x / 8;
    const auto word = [&](std::size_t side) { return (*masks_[side + beyond])[x % 8]; };
    const std::uint64_t at = word(0), z = word(4);
    const std::uint64_t next_y = at >> 8 | word(2) << 56, next_yz = z >> 8 | word(6) << 56;
    const auto step_z = [](std::uint64_t own, std::uint64_t above) {
      return (own >> 1 & ~kLastZ) | (above << 7 & kLastZ);
    };
    return {at, next_y, step_z(at, z), step_z(next_y, next_yz)};
  }

 private:
  std::array<const VoxelMask*, 8> masks_;
};

/// Calls visit(x, lower, upper) for the planes of corners of each of a block's eight layers.
template <typename Visit>
void ForLayers(const SurfaceCells& cells, std::size_t block, Visit&& visit) {
  const SignsAround around(cells, block);
  SignPlanes lower = around.At(0);
  for (std::size_t x = 0; x < 8; ++x) {
    const SignPlanes upper = around.At(x + 1);
    visit(x, lower, upper);
    lower = upper;
  }
}

/// Of 64 cells, those whose upper corner ends a crossed edge along an axis, and those where that
/// edge starts inside. Each edge is for the cell whose uppermost it is.
struct UpperEdges {
  std::uint64_t crossed, starts_inside;
};
inline std::array<UpperEdges, 3> UpperEdgesOf(const SignPlanes& lower, const SignPlanes& upper) {
  const auto edges = [&](std::uint64_t start) { return UpperEdges{start ^ upper.yz, start}; };
  return {edges(lower.yz), edges(upper.z), edges(upper.y)};
}

}  // namespace lascaux
