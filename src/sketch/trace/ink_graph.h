#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "sketch/trace/plane.h"

/// @file
/// Centre lines as a graph: branches between the places where they meet or end. Positions are pixel
/// centres: pixel (x, y) is the point (x + 0.5, y + 0.5) of the plane.

namespace lascaux::trace {

/// One of the two ends of a branch.
struct BranchEnd {
  int branch = -1, end = 0;

  bool operator==(const BranchEnd&) const = default;
};

/// A piece of centre line. A closed one has no nodes, and its last point is its first.
struct Branch {
  std::vector<Eigen::Vector2d> points;
  std::vector<double> half_widths;   ///< of the ink, one a point
  std::vector<bool> measured;        ///< by Centre(): the point is in the middle of the ink
  std::array<int, 2> nodes{-1, -1};  ///< where it begins and ends
  bool removed = false;
};

/// Where branches meet or one ends; a blot by itself has no branch.
struct InkNode {
  Eigen::Vector2d at;
  double half_width = 0;  ///< of the ink; 0 for a node that is no more
  std::vector<BranchEnd> ends;
};

struct InkGraph {
  std::vector<InkNode> nodes;
  std::vector<Branch> branches;
};

/// The graph of lines that are one pixel wide.
InkGraph GraphOf(const Mask& skeleton, const Plane<std::int32_t>& squared_distances);

/// Removes branches with a free end that are shorter than `widths` of the ink that they leave,
/// shortest first; what is left of a junction of three becomes one branch.
void RemoveSpurs(InkGraph& graph, double widths);

/// Length of a polyline.
double LengthOf(const std::vector<Eigen::Vector2d>& points);

}  // namespace lascaux::trace
