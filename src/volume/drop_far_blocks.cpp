#include <tbb/parallel_for.h>

#include <array>
#include <cstdint>
#include <utility>

#include "volume/band.h"

namespace lascaux {
namespace {

constexpr int kSides = 27;  // blocks around one, that one included, by -1, 0, 1 along x, y, z

Eigen::Vector3i StepOf(int side) { return {side / 9 - 1, side / 3 % 3 - 1, side % 3 - 1}; }

/// The eight bits of voxels along an axis, in the block at that step, that are within kBandVoxels
/// of the block it is seen from.
constexpr std::uint64_t NearBits(int step) {
  constexpr std::uint64_t kAll = 0xFF, kFirst = kAll >> (kBlockSide - kBandVoxels);
  return step < 0 ? kFirst << (kBlockSide - kBandVoxels) & kAll : step > 0 ? kFirst : kAll;
}

/// The same in space, for each of the blocks around.
std::array<VoxelMask, kSides> FindNearVoxels() {
  std::array<VoxelMask, kSides> near{};
  for (int side = 0; side < kSides; ++side) {
    const Eigen::Vector3i step = StepOf(side);
    std::uint64_t layer = 0;
    for (int y = 0; y < kBlockSide; ++y) {
      if ((NearBits(step.y()) >> y & 1) != 0) layer |= NearBits(step.z()) << kBlockSide * y;
    }
    for (int x = 0; x < kBlockSide; ++x) {
      if ((NearBits(step.x()) >> x & 1) != 0)
        near[static_cast<std::size_t>(side)][static_cast<std::size_t>(x)] = layer;
    }
  }
  return near;
}

bool Meet(const VoxelMask& a, const VoxelMask& b) {
  std::uint64_t both = 0;
  for (std::size_t x = 0; x < a.size(); ++x) both |= a[x] & b[x];
  return both != 0;
}

/// For each block, is it near a crossing? Not a vector of bool, which threads can't fill.
std::vector<std::uint8_t> FindNearBlocks(const Band& band,
                                         const std::vector<VoxelMask>& crossings) {
  static const std::array<VoxelMask, kSides> kNear = FindNearVoxels();
  const BlockMap map(band.origins);
  std::vector<std::uint8_t> is_near(band.size());
  tbb::parallel_for(std::size_t{0}, band.size(), [&](std::size_t b) {
    bool found = crossings[b] != VoxelMask{};
    for (int side = 0; side < kSides && !found; ++side) {
      const std::int32_t n = map.Find(band.origins[b] + kBlockSide * StepOf(side));
      found = n != kNoBlock &&
              Meet(crossings[static_cast<std::size_t>(n)], kNear[static_cast<std::size_t>(side)]);
    }
    is_near[b] = found ? 1 : 0;
  });
  return is_near;
}

}  // namespace

void DropFarBlocks(FoundBlocks& found, Band& band, std::vector<VoxelMask>& crossings) {
  const std::vector<std::uint8_t> is_near = FindNearBlocks(band, crossings);
  std::vector<std::int32_t> place(band.size(), kNoBlock);
  std::size_t kept = 0;
  for (std::size_t b = 0; b < band.size(); ++b) {
    if (is_near[b] == 0) {
      if ((band.inside[b][0] & 1) != 0) found.inside.push_back({band.origins[b], kBlockSide});
      continue;
    }
    place[b] = static_cast<std::int32_t>(kept);
    if (kept != b) {
      found.blocks[kept] = std::move(found.blocks[b]);
      band.origins[kept] = band.origins[b];
      band.neighbours[kept] = band.neighbours[b];
      band.inside[kept] = band.inside[b];
      crossings[kept] = crossings[b];
    }
    ++kept;
  }
  found.blocks.erase(found.blocks.begin() + static_cast<std::ptrdiff_t>(kept), found.blocks.end());
  band.origins.resize(kept);
  band.neighbours.resize(kept);
  band.inside.resize(kept);
  crossings.resize(kept);
  for (auto& neighbours : band.neighbours) {
    for (std::int32_t& n : neighbours) n = n == kNoBlock ? n : place[static_cast<std::size_t>(n)];
  }
}

}  // namespace lascaux
