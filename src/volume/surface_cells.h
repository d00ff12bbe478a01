#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lascaux/base/unset_allocator.h"
#include "lascaux/volume/narrow_band.h"
#include "lascaux/volume/voxel_floats.h"
#include "volume/block_map.h"
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

/// Unset by resize(): threads fill the blocks that they work on.
template <typename T>
using OfBlocks = std::vector<T, UnsetAllocator<T>>;

/// Crossed cells of a band, numbered block by block. Vertices of their pieces are in the same
/// order; quadrilaterals, one for each edge that is crossed, are in the blocks' order, too.
struct SurfaceCells {
  OfBlocks<BlocksAbove> above;                       ///< of each block, with itself
  OfBlocks<VoxelMask> inside;                        ///< voxels, of each block
  OfBlocks<VoxelMask> crossed;                       ///< cells, of each block
  OfBlocks<std::array<std::uint16_t, 8>> in_layers;  ///< crossed cells before each layer of x
  std::vector<std::uint32_t> first;                  ///< number of each block's first crossed cell
  std::vector<std::uint32_t> first_vertex, first_quad;  ///< of each block, and how many in all
  OfBlocks<CellSigns> signs;                            ///< of each crossed cell
  std::vector<std::uint32_t> apart;  ///< cells by PiecesApart instead of PiecesJoined, ascending

  std::size_t size() const { return inside.size(); }

  bool IsEmpty(std::size_t block) const { return first[block] == first[block + 1]; }

  /// Has each cell of a block one piece?
  bool HasSinglePieces(std::size_t block) const {
    return first[block + 1] - first[block] == first_vertex[block + 1] - first_vertex[block];
  }

  /// Number of a crossed cell.
  std::size_t Number(std::size_t block, std::size_t cell) const {
    const VoxelMask& mask = crossed[block];
    const std::uint64_t before = (std::uint64_t{1} << cell % 64) - 1;
    return first[block] + in_layers[block][cell / 64] + CountBits(mask[cell / 64] & before);
  }

  const CellPieces& Pieces(std::size_t number) const {
    return !apart.empty() && std::binary_search(apart.begin(), apart.end(), number)
               ? PiecesApart(signs[number])
               : PiecesJoined(signs[number]);
  }

  /// The vertex of a cell's first piece.
  std::uint32_t FirstVertex(std::size_t block, std::size_t number) const {
    std::uint32_t vertex = first_vertex[block];
    if (HasSinglePieces(block)) return vertex + static_cast<std::uint32_t>(number - first[block]);
    for (std::size_t n = first[block]; n < number; ++n) vertex += Pieces(n).count;
    return vertex;
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
