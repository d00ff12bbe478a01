#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "lascaux/volume/narrow_band.h"
#include "volume/surface_cells.h"

namespace lascaux {

/// Where vertices go: as places in their cells, 0 to 1, and in the band's frame.
struct PlacedVertices {
  Eigen::Vector3f* in_cell;
  Eigen::Vector3f* in_model;
};

using BlockValues = std::array<float, kBlockVoxels>;

/// Where the surface crosses the edges of a block's cells.
class CellVertices {
 public:
  /// `missing` is what blocks that are not there hold: the background.
  CellVertices(const NarrowBand& band, const SurfaceCells& cells, std::size_t block,
               const BlockValues& missing);

  /// The mean of each cell's crossings, of all of its pieces: cell by cell, in that order.
  void PlaceMeans(std::span<const std::uint16_t> cells, const CellSigns* signs,
                  const PlacedVertices& to) const;

  /// The means of each of a cell's pieces, in the cell. As many as there are; what is behind them
  /// means nothing.
  std::array<Eigen::Vector3f, 4> In(std::size_t cell, const CellPieces& pieces) const;

 private:
  // Along x, y, z between the voxels of the block and those one step beyond.
  static constexpr std::array<std::size_t, 3> kStride = {81, 9, 1};

  double voxel_size_;
  Eigen::Vector3d origin_, lowest_;  ///< the band's, and of the block's lowest voxel, in voxels
  float least_;  ///< no distance is so close to 0 that vertices could fall on one point
  std::array<float, 9 * 9 * 9> values_;  ///< beside crossed cells; others are unset
};

}  // namespace lascaux
