#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lascaux/base/execution.h"
#include "lascaux/field/compiled_field.h"
#include "lascaux/volume/voxel_floats.h"
#include "volume/block_map.h"
#include "volume/find_blocks.h"

/// @file
/// The band before it becomes a grid: blocks of 8 x 8 x 8 distances, in voxels, with their
/// neighbours. Voxel (x, y, z) of a block is at 64 x + 8 y + z, as in OpenVDB's leaves.

namespace lascaux {

/// Larger than any distance that matters, in voxels.
inline constexpr float kFar = 16;

/// As far as distances are computed: the band, and what the scheme may err there.
inline constexpr float kSweepVoxels = 3.25F;

/// Blocks, with their values.
struct Band {
  bool upper_half = false;  ///< values at -z are those at z, and no block has z < 0
  std::vector<Eigen::Vector3i> origins;
  std::vector<std::array<std::int32_t, 6>> neighbours;  ///< at -x, +x, -y, +y, -z, +z, or kNoBlock
  std::vector<VoxelMask> inside;                        ///< F > 1
  VoxelFloats distance;                                 ///< in voxels, >= 0, kBlockVoxels a block

  std::size_t size() const noexcept { return origins.size(); }
};

/// What a band is made from.
struct BandSource {
  const CompiledField& field;
  const std::vector<Block>& blocks;
  double voxel_size;
};

/// Evaluates the field in each block: `inside`, and no distances yet.
Band FindInside(const BandSource& source, const Execution& execution);

/// Voxels with a neighbour along an axis on the other side of the surface, for each block.
std::vector<VoxelMask> FindCrossings(const Band& band);

/// Fills in `neighbours`.
void ConnectBlocks(Band& band);

/// Drops the blocks in which nothing is within the band, for no crossing is as near; those inside
/// become cubes. Bounds alone leave twice as many blocks as have a band. Before any distance is
/// set.
void DropFarBlocks(FoundBlocks& found, Band& band, std::vector<VoxelMask>& crossings);

/// Sets `distance` to the first-order distance at the crossings; where that is below about one
/// voxel, measured once more from the foot of the perpendicular. kFar elsewhere.
void MeasureCrossings(const BandSource& source, const std::vector<VoxelMask>& crossings, Band& band,
                      const Execution& execution);

/// Keeps the distances of the voxels in `crossings` and replaces all others by the solution of
/// |grad d| = 1 from there, as far as kSweepVoxels.
///
/// Godunov's upwind scheme, solved to its fixed point: Gauss-Seidel within a block, blocks like the
/// fields of a chessboard one colour after the other, so that the bits are the same for any number
/// of threads. Source: H. Zhao, "A fast
/// sweeping method for Eikonal equations", Mathematics of Computation 74(250), 2005. The same bits
/// for every `isa`, which must be supported.
void SweepDistances(Band& band, const std::vector<VoxelMask>& crossings, Isa isa,
                    const Execution& execution);

/// Replaces swept distances by the distance to the plane that is tangent to the surface at the foot
/// of the perpendicular: second order where the scheme is first. `source` as for FindInside.
void RefineDistances(const BandSource& source, const std::vector<VoxelMask>& crossings, Band& band,
                     const Execution& execution);

}  // namespace lascaux
