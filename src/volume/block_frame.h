#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "lascaux/volume/narrow_band.h"
#include "volume/four.h"

namespace lascaux {

/// Four cells of a block.
struct FourCells {
  FourInts x, y, z;

  /// Of cells 64 x + 8 y + z.
  LASCAUX_INLINE explicit FourCells(const FourInts& cells)
      : x(cells >> 6), y(cells >> 3 & 7), z(cells & 7) {}
};

/// Where a block's cells are in the model.
class BlockFrame {
 public:
  BlockFrame(const NarrowBand& band, std::size_t block) {
    voxel_size_.fill(band.voxel_size);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      origin_[axis].fill(band.origin[static_cast<Eigen::Index>(axis)]);
      lowest_[axis].fill(band.blocks[block][static_cast<Eigen::Index>(axis)]);
    }
  }

  /// Of places in cells, 0 to 1.
  LASCAUX_INLINE FourPoints InModel(const FourCells& cells, const FourPoints& in_cell) const {
    return {Along(0, cells.x, in_cell.x), Along(1, cells.y, in_cell.y),
            Along(2, cells.z, in_cell.z)};
  }

 private:
  using Same = std::array<double, 4>;  ///< one number for four cells, as it is loaded

  LASCAUX_INLINE Four Along(std::size_t axis, const FourInts& cells, const Four& in_cell) const {
    FourDoubles voxel_size, origin, lowest;
    std::memcpy(&voxel_size, &voxel_size_, sizeof voxel_size);
    std::memcpy(&origin, &origin_[axis], sizeof origin);
    std::memcpy(&lowest, &lowest_[axis], sizeof lowest);
    const FourDoubles voxels = (lowest + __builtin_convertvector(cells, FourDoubles)) +
                               __builtin_convertvector(in_cell, FourDoubles);
    return __builtin_convertvector(origin + voxel_size * voxels, Four);
  }

  Same voxel_size_;
  std::array<Same, 3> origin_, lowest_;  ///< the band's, and the block's lowest voxel
};

}  // namespace lascaux
