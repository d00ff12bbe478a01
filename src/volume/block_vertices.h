#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "volume/surface_cells.h"

namespace lascaux {

/// The vertices of a block's crossed cells and of those one step beyond along x, y, z.
class BlockVertices {
 public:
  /// Between cells along x, y, z.
  static constexpr std::array<std::size_t, 3> kStride = {81, 9, 1};

  /// In place of a cell's vertex where it has more than one piece.
  static constexpr std::uint32_t kSeveral = 0xFFFFFFFF;

  BlockVertices(const SurfaceCells& cells, std::size_t block);

  /// Place of the block's cell 64 x + 8 y + z.
  static std::size_t PlaceOf(std::size_t cell) {
    return cell + cell / 8 + 9 * (cell / 64);  // 81 x + 9 y + z
  }

  /// Precondition: the cell at that place is crossed.
  std::uint32_t At(std::size_t place) const { return vertices_[place]; }

  /// Is any of them kSeveral?
  bool HasSeveral() const { return has_several_; }

  /// The vertex of the piece that crosses an edge (CellEdge) of the cell at a place.
  std::uint32_t VertexAtEdge(std::size_t place, std::size_t edge) const;

 private:
  static constexpr std::size_t kPlaces = 9 * 9 * 9;

  void AddOwn();
  void AddBeyond(std::size_t side);

  const SurfaceCells& cells_;
  std::size_t block_;
  bool has_several_ = false;
  std::array<std::uint32_t, kPlaces> vertices_;  // of crossed cells; others are unset
};

}  // namespace lascaux
