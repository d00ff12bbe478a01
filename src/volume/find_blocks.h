#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "lascaux/base/execution.h"
#include "lascaux/field/compiled_field.h"
#include "lascaux/volume/narrow_band.h"

namespace lascaux {

/// A leaf's worth of voxels that may be near the surface, with what matters there.
struct Block {
  Eigen::Vector3i origin;
  ActiveSet active;
  /// Set when the bounds say that all of its voxels are inside or all outside: the surface is
  /// beside it.
  std::optional<bool> inside = std::nullopt;
};

/// Which voxels to look at.
struct BlockSearch {
  double voxel_size = 0;
  double margin = 0;        ///< in voxels: surface that is this close counts
  bool upper_half = false;  ///< only blocks with z >= 0
};

/// Blocks in an order that depends on the field alone, and the cubes wholly inside.
///
/// Everything that is in neither has F < 1 for at least `margin` voxels around. Nothing of it is
/// sampled: the bounds hold for all points of a block.
struct FoundBlocks {
  std::vector<Block> blocks;
  std::vector<Cube> inside;
};

/// Coarse to fine: cubes of 64, 32 and 16 voxels down to blocks, as long as the bounds leave a
/// doubt.
FoundBlocks FindBlocks(const CompiledField& field, const BlockSearch& search,
                       const Execution& execution);

}  // namespace lascaux
