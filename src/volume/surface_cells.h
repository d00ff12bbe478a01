#pragma once

#include <Eigen/Core>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lascaux/volume/narrow_band.h"
#include "volume/cell_table.h"

/// @file
/// The cells between eight voxel centres that the surface runs through, block by block. A cell has
/// the number of its lowest voxel.

namespace lascaux {

/// A block and those beside it: bit 0 of the index is one step along +x, bit 1 +y, bit 2 +z.
using BlocksAbove = std::array<std::int32_t, 8>;

/// std::popcount, which without an instruction for it is a call.
inline std::size_t CountBits(std::uint64_t word) {
  word -= word >> 1 & 0x5555555555555555;
  word = (word & 0x3333333333333333) + (word >> 2 & 0x3333333333333333);
  return ((word + (word >> 4)) & 0x0F0F0F0F0F0F0F0F) * 0x0101010101010101 >> 56;
}

/// Crossed cells of a band.
struct SurfaceCells {
  std::vector<BlocksAbove> above;                  ///< of each block, with itself
  std::vector<std::array<std::int32_t, 3>> below;  ///< of each block at -x, -y, -z
  std::vector<VoxelMask> inside;                   ///< voxels, of each block
  std::vector<VoxelMask> crossed;                  ///< cells, of each block
  std::vector<std::uint32_t> first;                ///< number of each block's first crossed cell
  std::vector<std::array<std::uint16_t, 8>> in_layers;  ///< crossed cells before each layer of x
  std::vector<CellSigns> signs;                         ///< of each crossed cell
  std::vector<std::uint8_t> apart;  ///< of each: by PiecesApart instead of PiecesJoined

  /// Number of a crossed cell.
  std::size_t Number(std::size_t block, std::size_t cell) const {
    const VoxelMask& mask = crossed[block];
    const std::uint64_t before = (std::uint64_t{1} << cell % 64) - 1;
    return first[block] + in_layers[block][cell / 64] + CountBits(mask[cell / 64] & before);
  }

  const CellPieces& Pieces(std::size_t number) const {
    return apart[number] != 0 ? PiecesApart(signs[number]) : PiecesJoined(signs[number]);
  }

  /// Calls visit(cell, number) for each crossed cell of a block, in order.
  template <typename Visit>
  void ForCells(std::size_t block, Visit&& visit) const {
    std::size_t number = first[block];
    for (std::size_t x = 0; x < 8; ++x) {
      for (std::uint64_t word = crossed[block][x]; word != 0; word &= word - 1)
        visit(64 * x + static_cast<std::size_t>(std::countr_zero(word)), number++);
    }
  }
};

/// Linear in the number of blocks; the same for any number of threads.
SurfaceCells FindSurfaceCells(const NarrowBand& band);

}  // namespace lascaux
