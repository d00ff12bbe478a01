#pragma once

#include <Eigen/Core>
#include <vector>

namespace lascaux {

/// Counter-clockwise, no three corners on a line; fewer than three corners where all points are on
/// one line. Source: A. M. Andrew, "Another efficient algorithm for convex hulls in two
/// dimensions", Information Processing Letters 9(5), 1979.
std::vector<Eigen::Vector2d> ConvexHull(std::vector<Eigen::Vector2d> points);

/// Distance to the border of a hull, positive within it.
double SignedDistanceInside(const Eigen::Vector2d& p, const std::vector<Eigen::Vector2d>& hull);

/// The nearest point of the border of a hull, which is not empty.
Eigen::Vector2d NearestOnBorder(const Eigen::Vector2d& p, const std::vector<Eigen::Vector2d>& hull);

}  // namespace lascaux
