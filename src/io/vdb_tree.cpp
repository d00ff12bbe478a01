#include "io/vdb_tree.h"

#include <algorithm>
#include <cstddef>

namespace lascaux {
namespace {

constexpr int kLowerSide = 128, kUpperSide = 4096;  // voxels

/// Where a child of side `child` stands in the table of its node of side `node`.
std::uint16_t PlaceIn(const Eigen::Vector3i& voxel, int node, int child) {
  int place = 0;
  for (int axis = 0; axis < 3; ++axis)
    place = place * (node / child) + (voxel[axis] & (node - 1)) / child;
  return static_cast<std::uint16_t>(place);
}

VdbLowerNode& NodeAt(VdbTree& tree, const Eigen::Vector3i& voxel) {
  constexpr int kMask = ~(kUpperSide - 1);
  VdbUpperNode& upper = tree[{voxel.x() & kMask, voxel.y() & kMask, voxel.z() & kMask}];
  return upper.lower[PlaceIn(voxel, kUpperSide, kLowerSide)];
}

}  // namespace

VdbTree TreeOf(const NarrowBand& band) {
  VdbTree tree;
  for (const Cube& cube : band.inside) {
    // A cube's side divides a node's, and its origin is a multiple of it.
    VdbLowerNode& node = NodeAt(tree, cube.origin);
    for (int x = 0; x < cube.side; x += kBlockSide) {
      for (int y = 0; y < cube.side; y += kBlockSide) {
        for (int z = 0; z < cube.side; z += kBlockSide) {
          const std::size_t place =
              PlaceIn(cube.origin + Eigen::Vector3i(x, y, z), kLowerSide, kBlockSide);
          node.inside[place / 64] |= std::uint64_t{1} << place % 64;
        }
      }
    }
  }
  for (std::uint32_t b = 0; b < band.size(); ++b) {
    VdbLowerNode& node = NodeAt(tree, band.blocks[b]);
    const std::uint16_t place = PlaceIn(band.blocks[b], kLowerSide, kBlockSide);
    node.leaves[place / 64U] |= std::uint64_t{1} << place % 64U;
    node.blocks.emplace_back(place, b);
  }
  for (auto& [origin, upper] : tree) {
    for (auto& [at, node] : upper.lower) std::sort(node.blocks.begin(), node.blocks.end());
  }
  return tree;
}

}  // namespace lascaux
