#pragma once

#include <openvdb/openvdb.h>

#include <vector>

#include "volume/band.h"
#include "volume/find_blocks.h"

namespace lascaux {

/// Smallest float that is at least kBandVoxels voxels.
float BandBackground(double voxel_size);

/// The grid of a swept band, the lower half mirrored from the upper where only that was computed.
///
/// Leaves hold at least one voxel of the band each; cubes inside and blocks without band become
/// inactive tiles. No distance is below kLeastDistance, so that no vertices of a mesh fall on one
/// point.
openvdb::FloatGrid::Ptr WriteGrid(const Band& band, const std::vector<Cube>& inside,
                                  double voxel_size);

/// In voxels. Where only one voxel centre is inside, the vertices around it are this far apart,
/// which single precision still tells from one point 30 000 voxels from the origin.
inline constexpr float kLeastDistance = 4e-3F;

}  // namespace lascaux
