#include "volume/render/leaf_table.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <limits>

namespace lascaux {
namespace {

using Eigen::Vector3i;

constexpr int kLog = 3;
static_assert(1 << kLog == kBlockSide);

Vector3i LeafOf(const Vector3i& voxel) {
  return {voxel.x() >> kLog, voxel.y() >> kLog, voxel.z() >> kLog};
}

/// First and last leaf.
Eigen::AlignedBox3i LeafBox(const NarrowBand& band) {
  Eigen::AlignedBox3i box;
  for (const Vector3i& block : band.blocks) box.extend(LeafOf(block));
  for (const Cube& cube : band.inside) {
    box.extend(LeafOf(cube.origin));
    box.extend(LeafOf(cube.origin + Vector3i::Constant(cube.side - 1)));
  }
  if (box.isEmpty()) box.extend(Vector3i(0, 0, 0));
  return box;
}

/// First and last active voxel of a block, from its lowest one; empty if there is none.
Eigen::AlignedBox3i ActiveBox(const VoxelMask& mask) {
  Eigen::AlignedBox3i box;
  std::uint64_t any = 0;
  for (int x = 0; x < kBlockSide; ++x) {
    const std::uint64_t word = mask[static_cast<std::size_t>(x)];
    if (word == 0) continue;
    any |= word;
    box.extend(Vector3i(x, 0, 0));
  }
  if (any == 0) return box;
  box.min().y() = std::countr_zero(any) / kBlockSide;
  box.max().y() = (63 - std::countl_zero(any)) / kBlockSide;
  for (int shift = 32; shift >= kBlockSide; shift /= 2) any |= any >> shift;
  const auto line = static_cast<std::uint8_t>(any);
  box.min().z() = std::countr_zero(line);
  box.max().z() = 7 - std::countl_zero(line);
  return box;
}

}  // namespace

LeafTable::LeafTable(const Vector3i& first_leaf, const Vector3i& last_leaf, float outside)
    : background(outside), first(first_leaf), size(last_leaf - first_leaf + Vector3i(1, 1, 1)) {
  auto both = std::make_shared<std::array<Leaf, 2>>();
  (*both)[0].fill(background);
  (*both)[1].fill(-background);
  constant = std::move(both);
  leaves.assign(Index(size - Vector3i(1, 1, 1)) + 1, (*constant)[0].data());
}

LeafTable::LeafTable(const NarrowBand& band)
    : LeafTable(LeafBox(band).min(), LeafBox(band).max(), band.background) {
  voxel_size = static_cast<float>(band.voxel_size);
  Eigen::AlignedBox3i active;
  for (std::size_t b = 0; b < band.size(); ++b) {
    leaves[Index(LeafOf(band.blocks[b]) - first)] = band.values.data() + kBlockVoxels * b;
    const Eigen::AlignedBox3i box = ActiveBox(band.active[b]);
    if (box.isEmpty()) continue;
    active.extend(Vector3i(band.blocks[b] + box.min()));
    active.extend(Vector3i(band.blocks[b] + box.max()));
  }
  if (!active.isEmpty()) active_low = active.min(), active_high = active.max();
  for (const Cube& cube : band.inside) {
    const Vector3i low = LeafOf(cube.origin) - first;
    const int side = cube.side / kBlockSide;
    for (int x = 0; x < side; ++x)
      for (int y = 0; y < side; ++y)
        std::fill_n(leaves.begin() + static_cast<std::ptrdiff_t>(Index(low + Vector3i(x, y, 0))),
                    side, (*constant)[1].data());
  }
}

}  // namespace lascaux
