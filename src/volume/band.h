#pragma once

#include <openvdb/openvdb.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lascaux/base/execution.h"
#include "lascaux/field/compiled_field.h"
#include "volume/find_blocks.h"

/// @file
/// The band before it becomes a grid: blocks of 8 x 8 x 8 distances, in voxels, with their
/// neighbours. Voxel (x, y, z) of a block is at 64 x + 8 y + z, as in OpenVDB's leaves.

namespace lascaux {

inline constexpr std::size_t kBlockVoxels = 512;
inline constexpr std::int32_t kNoBlock = -1;

/// Larger than any distance that matters, in voxels.
inline constexpr float kFar = 16;

/// One bit a voxel, one word for each x: bit 8 y + z.
using VoxelMask = std::array<std::uint64_t, 8>;

/// Blocks, with their values.
struct Band {
  bool upper_half = false;  ///< values at -z are those at z, and no block has z < 0
  std::vector<openvdb::Coord> origins;
  std::vector<std::array<std::int32_t, 6>> neighbours;  ///< at -x, +x, -y, +y, -z, +z, or kNoBlock
  std::vector<VoxelMask> inside;                        ///< F > 1
  std::vector<float> distance;                          ///< in voxels, >= 0, kBlockVoxels a block

  std::size_t size() const noexcept { return origins.size(); }
};

/// Evaluates the field in each block: `inside`, and as `distance` the first-order distance, capped
/// at kFar; where that is below about one voxel, once more from the foot of the perpendicular.
Band EvaluateBand(const CompiledField& field, const std::vector<Block>& blocks, double voxel_size,
                  const Execution& execution);

/// Voxels with a neighbour along an axis on the other side of the surface, for each block.
std::vector<VoxelMask> FindCrossings(const Band& band);

/// Fills in `neighbours`.
void ConnectBlocks(Band& band);

/// Keeps the distances of the voxels in `crossings` (capped at 1, which they can't exceed) and
/// replaces all others by the solution of |grad d| = 1 from there, as far as kBandVoxels.
///
/// Godunov's upwind scheme, solved by Jacobi iteration to its fixed point: the same bits for any
/// number of threads, and symmetric where the input is. Source: H. Zhao, "A fast sweeping method
/// for Eikonal equations", Mathematics of Computation 74(250), 2005, for the scheme.
void SweepDistances(Band& band, const std::vector<VoxelMask>& crossings,
                    const Execution& execution);

}  // namespace lascaux
