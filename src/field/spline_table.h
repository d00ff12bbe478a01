#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "block_kernel.h"
#include "lascaux/field/depth_map.h"
#include "lascaux/field/planar_gain.h"

/// @file
/// The tables over the plane as the vector code takes them.

namespace lascaux::internal {

/// Coefficients of one or two splines, with what is beyond the table around them.
class SplineTable {
 public:
  explicit SplineTable(const DepthMap& map);
  explicit SplineTable(const PlanarGain& gain);

  /// The table seen from a place. Points into this one.
  KernelTable From(const Eigen::Vector2d& origin) const;

  /// Least and greatest coefficients of each spline that matter in a box: the convex hull of the
  /// values.
  struct Extent {
    float low[2], high[2];
  };
  Extent ExtentOn(const Eigen::AlignedBox2d& box, const BlockKernel& kernel) const;

  /// The same on a somewhat larger box, in a fraction of the time.
  Extent RoughExtentOn(const Eigen::AlignedBox2d& box) const;

  /// Bounds of a depth map's splines and of their gradients' lengths in a box.
  struct MapBounds {
    Extent extent;
    float slope[2];
  };
  MapBounds BoundsOn(const Eigen::AlignedBox2d& box) const;

 private:
  struct Shape {
    int channels, columns, rows;
  };
  template <typename At>
  void Fill(const Shape& shape, const At& at);
  void FindTileExtents();
  void FindWindows();
  KernelRectangle CellsOf(const Eigen::AlignedBox2d& box) const;
  Eigen::Vector2d InCells(const Eigen::Vector2d& place) const;

  Eigen::Vector2d origin_;
  double cell_;
  Shape shape_{};
  int stride_ = 0;
  std::vector<float> coefficients_;
  int tiles_across_ = 0;
  std::vector<Extent> tiles_;  ///< extents of square tiles of the coefficients

  /// Of the square window of coefficients that begins at each, of a depth map: extents, and the
  /// largest differences between one and the next along x and y.
  std::vector<float> least_, greatest_, by_x_, by_y_;
};

}  // namespace lascaux::internal
