#pragma once

#include <Eigen/Core>
#include <vector>

#include "lascaux/field/compiled_field.h"
#include "lascaux/volume/narrow_band.h"

namespace lascaux {

/// Points of a surface within a block's cells.
struct BlockPoints {
  std::vector<Eigen::Vector3f> places;   ///< in voxels from the block's lowest voxel
  std::vector<Eigen::Vector3f> outward;  ///< against the field's gradient; (0, 0, 0): not known
};

/// The points after one step of Newton's method from each place towards F = 1, along the gradient.
/// What is farther away than the surface nets' mean ever is belongs to another piece of the surface
/// and stays, without a direction.
BlockPoints MoveOntoSurface(const CompiledField& field, const NarrowBand& band, std::size_t block,
                            std::vector<Eigen::Vector3f> places);

}  // namespace lascaux
