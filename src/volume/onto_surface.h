#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "lascaux/field/compiled_field.h"
#include "lascaux/volume/narrow_band.h"

namespace lascaux {

/// Vertices that are each alone in a cell of a block.
struct BlockPoints {
  std::size_t count = 0;
  std::array<std::uint16_t, kBlockVoxels> cells;  ///< 64 x + 8 y + z
  std::array<float, kBlockVoxels> x, y, z;        ///< in voxels from the block's lowest voxel
  std::array<float, kBlockVoxels> outward_x, outward_y, outward_z;

  /// Precondition: places are filled up to a multiple of four.
  ///
  /// Moves each by one step of Newton's method towards F = 1, along the gradient, and sets the
  /// directions against that; (0, 0, 0): not known. What is farther away than the surface nets'
  /// mean ever is belongs to another piece of the surface and stays, without a direction.
  void MoveOntoSurface(const CompiledField& field, const NarrowBand& band, std::size_t block);
};

}  // namespace lascaux
