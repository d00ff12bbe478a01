#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "lascaux/volume/narrow_band.h"
#include "volume/surface_cells.h"

namespace lascaux {

/// Where the surface crosses the edges of a block's cells.
class CellVertices {
 public:
  /// `above` are the block and those beside it.
  CellVertices(const NarrowBand& band, const BlocksAbove& above);
  CellVertices(const CellVertices&) = delete;  // it points into itself
  CellVertices& operator=(const CellVertices&) = delete;

  /// The mean of a cell's crossings, in the cell: 0 to 1. It has one piece.
  Eigen::Vector3f InOnePiece(std::size_t cell, CellSigns signs) const;

  /// The means of each of a cell's pieces. As many as there are; what is behind them means nothing.
  std::array<Eigen::Vector3f, 4> In(std::size_t cell, const CellPieces& pieces) const;

 private:
  /// Four to an axis, in the order of CellEdge.
  using Four [[gnu::vector_size(16)]] = float;
  std::array<Four, 3> CrossingsOf(std::size_t cell) const;

  float least_;  ///< no distance is so close to 0 that vertices could fall on one point
  std::array<const float*, 8> values_;
  std::array<float, kBlockVoxels> missing_;  ///< of blocks that are not there
};

}  // namespace lascaux
