#pragma once

#include <Eigen/Core>
#include <vector>

#include "lascaux/field/compiled_field.h"
#include "lascaux/volume/narrow_band.h"

namespace lascaux {

/// Places within a block's cells, in voxels from the block's lowest voxel.
using BlockPlaces = std::vector<Eigen::Vector3f>;

/// One step of Newton's method from each place towards F = 1, along the gradient. What is farther
/// away than the surface nets' mean ever is belongs to another piece of the surface and stays.
void MoveOntoSurface(const CompiledField& field, const NarrowBand& band, std::size_t block,
                     BlockPlaces& places);

}  // namespace lascaux
