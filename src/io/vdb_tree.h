#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "lascaux/volume/narrow_band.h"

/// @file
/// A narrow band in the order of the tree in an OpenVDB file: a root, nodes of 32^3 nodes of 16^3
/// leaves of 8^3 voxels.

namespace lascaux {

/// A node of leaves, as bits in the order of its table: x slowest.
struct VdbLowerNode {
  std::array<std::uint64_t, 64> leaves{}, inside{};
  std::vector<std::pair<std::uint16_t, std::uint32_t>> blocks;  ///< place and block, ascending
};

struct VdbUpperNode {
  std::map<std::uint16_t, VdbLowerNode> lower;  ///< by place
};

/// By the lowest voxel.
using VdbTree = std::map<std::array<int, 3>, VdbUpperNode>;

VdbTree TreeOf(const NarrowBand& band);

}  // namespace lascaux
