#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "lascaux/volume/narrow_band.h"
#include "volume/surface_cells.h"

namespace lascaux {

using BlockValues = std::array<float, kBlockVoxels>;

/// Where the surface crosses the edges of a block's cells.
class CellVertices {
 public:
  /// `missing` is what blocks that are not there hold: the background.
  CellVertices(const NarrowBand& band, const SurfaceCells& cells, std::size_t block,
               const BlockValues& missing);

  /// The mean of each cell's crossings, of all of its pieces, in the cell: 0 to 1. Cell by cell, in
  /// that order.
  void PlaceMeans(std::span<const std::uint16_t> cells, const CellSigns* signs,
                  Eigen::Vector3f* to) const;

  /// The means of each of a cell's pieces, in the cell. As many as there are; what is behind them
  /// means nothing.
  std::array<Eigen::Vector3f, 4> In(std::size_t cell, const CellPieces& pieces) const;

 private:
  // Along x, y, z between the voxels of the block and those one step beyond.
  static constexpr std::array<std::size_t, 3> kStride = {81, 9, 1};

  float least_;  ///< no distance is so close to 0 that vertices could fall on one point
  std::array<float, 9 * 9 * 9> values_;  ///< beside crossed cells; others are unset
};

/// Takes vertices from their cells to the band's frame; `cells` are theirs.
void PlaceInModel(const NarrowBand& band, std::size_t block, std::span<const std::uint16_t> cells,
                  Eigen::Vector3f* vertices);

}  // namespace lascaux
