#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

/// @file
/// Where a part lies in depth, and how deep it is, as smooth functions over the xy plane.
///
/// A planar skeleton's field depends on z only through the distance from its plane. Moving that
/// plane to z = middle(x, y) and scaling the distance from it by a factor that depends on x and y
/// alone leaves the greatest value on each line along z as it was: the silhouette from the side
/// does not change, whatever the map.

namespace lascaux {

/// Uniform bicubic B-splines; beyond the table, the coefficients at its border go on.
struct DepthMap {
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  ///< place of coefficient (0, 0)
  double cell = 1;                                   ///< distance of coefficients, > 0
  int columns = 0, rows = 0;
  std::vector<float> middle;  ///< rows of z, columns * rows
  std::vector<float>
      steepness;  ///< rows of depth in the part's flat space over depth in space, > 0

  bool operator==(const DepthMap&) const = default;
};

/// Both functions at a place, with their derivatives by x and y.
struct DepthSample {
  double middle = 0, steepness = 1;
  Eigen::Vector2d middle_gradient = Eigen::Vector2d::Zero();
  Eigen::Vector2d steepness_gradient = Eigen::Vector2d::Zero();
};

/// Twice continuously differentiable; about 40 ns.
DepthSample EvaluateDepth(const DepthMap& map, const Eigen::Vector2d& place);

/// Least and greatest values on a box, by the convex hull of the coefficients: rigorous, and not
/// tight.
struct DepthRange {
  double middle_low = 0, middle_high = 0, steepness_low = 1, steepness_high = 1;
};
DepthRange RangeOf(const DepthMap& map, const Eigen::AlignedBox2d& box);

}  // namespace lascaux
