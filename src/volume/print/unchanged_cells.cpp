#include "volume/print/unchanged_cells.h"

#include <tbb/parallel_for.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include "volume/block_map.h"

namespace lascaux {
namespace {

constexpr std::uint64_t kLastZ = 0x8080808080808080;  // the bits with z = 7

VoxelMask EqualVoxels(const float* a, const float* b) {
  VoxelMask mask{};
  for (std::size_t i = 0; i < kBlockVoxels; ++i)
    mask[i / 64] |= static_cast<std::uint64_t>(a[i] == b[i]) << i % 64;
  return mask;
}

/// The voxels of one band that are the same in another.
class Comparison {
 public:
  Comparison(const NarrowBand& before, const NarrowBand& after)
      : before_(before), after_(after), map_before_(before.blocks), map_after_(after.blocks) {}

  /// A block that neither band has is the same.
  VoxelMask Of(const Eigen::Vector3i& block) const {
    const std::int32_t a = map_before_.Find(block), b = map_after_.Find(block);
    if (a != kNoBlock && b != kNoBlock) return EqualVoxels(Values(before_, a), Values(after_, b));
    VoxelMask mask{};
    if (a == b) mask.fill(~std::uint64_t{0});
    return mask;
  }

 private:
  static const float* Values(const NarrowBand& band, std::int32_t block) {
    return band.values.data() + kBlockVoxels * static_cast<std::size_t>(block);
  }

  const NarrowBand& before_;
  const NarrowBand& after_;
  BlockMap map_before_, map_after_;
};

/// Of 64 voxels with one x, and of those one step along y, z and both: what is in all four.
std::uint64_t InAllFour(std::uint64_t at, std::uint64_t y, std::uint64_t z, std::uint64_t yz) {
  const std::uint64_t low = at & (at >> 8 | y << 56), high = z & (z >> 8 | yz << 56);
  return low & ((low >> 1 & ~kLastZ) | (high << 7 & kLastZ));
}

/// From the voxels of the block itself and of those above: bit 0 of the index is a step along x, 1
/// along y, 2 along z.
VoxelMask CellsBetween(const std::array<VoxelMask, 8>& voxels) {
  const auto plane = [&voxels](std::size_t x) {
    const std::size_t beyond = x / 8;
    const auto word = [&](std::size_t side) { return voxels[side + beyond][x % 8]; };
    return InAllFour(word(0), word(2), word(4), word(6));
  };
  VoxelMask cells;
  for (std::size_t x = 0; x < 8; ++x) cells[x] = plane(x) & plane(x + 1);
  return cells;
}

}  // namespace

std::vector<VoxelMask> UnchangedCells(const NarrowBand& before, const NarrowBand& after) {
  const Comparison comparison(before, after);
  std::vector<VoxelMask> cells(after.size());
  tbb::parallel_for(std::size_t{0}, after.size(), [&](std::size_t b) {
    std::array<VoxelMask, 8> voxels;
    for (int side = 0; side < 8; ++side) {
      const Eigen::Vector3i step(side & 1, side >> 1 & 1, side >> 2);
      voxels[static_cast<std::size_t>(side)] = comparison.Of(after.blocks[b] + kBlockSide * step);
    }
    cells[b] = CellsBetween(voxels);
  });
  return cells;
}

}  // namespace lascaux
