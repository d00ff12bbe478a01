#pragma once

#include <vector>

#include "lascaux/volume/narrow_band.h"
#include "volume/band.h"

namespace lascaux {

/// Smallest float that is at least kBandVoxels voxels.
float BandBackground(double voxel_size);

/// What a swept band becomes, the lower half mirrored from the upper where only that was computed.
///
/// Blocks hold at least one voxel of the band each; blocks without become cubes where they are
/// inside. No distance is below kLeastDistance, so that no vertices of a mesh fall on one point.
NarrowBand FinishBand(const Band& band, const std::vector<Cube>& inside, double voxel_size);

/// In voxels. Where only one voxel centre is inside, the vertices around it are this far apart,
/// which single precision still tells from one point 30 000 voxels from the origin.
inline constexpr float kLeastDistance = 4e-3F;

}  // namespace lascaux
