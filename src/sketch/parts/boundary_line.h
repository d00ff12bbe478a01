#pragma once

#include <Eigen/Core>
#include <vector>

#include "lascaux/sketch/planar_map.h"
#include "sketch/parts/boundary.h"

/// @file
/// The boundary as one closed polyline with arc length, so that a limb may be cut at any place of it.

namespace lascaux {

/// Closed walk around a face; places on it are arc lengths, taken modulo `length`.
struct BoundaryLine {
  Polyline points;                 ///< the last is joined to the first
  std::vector<int> half_edges;     ///< of the piece from points[i] to the next
  std::vector<double> arcs;        ///< of points[i]
  std::vector<double> node_arcs;   ///< of the beginning of each half-edge of the Boundary
  double length = 0;

  /// The place, brought into [0, length).
  double Wrap(double arc) const;
  /// Length of the walk from one place to another, in [0, length).
  double Ahead(double from, double to) const { return Wrap(to - from); }
  Eigen::Vector2d At(double arc) const;
  /// Unit direction of the walk just before and just after a place, over `reach`.
  Eigen::Vector2d DirectionBefore(double arc, double reach) const;
  Eigen::Vector2d DirectionAfter(double arc, double reach) const;
};

/// A stretch of the walk.
struct BoundaryStretch {
  Polyline points;               ///< both ends included
  std::vector<int> half_edges;   ///< one for each piece between two points
};

BoundaryLine LineOf(const PlanarMap& map, const Boundary& boundary);

/// The walk from one place to another, going ahead.
BoundaryStretch Stretch(const BoundaryLine& line, double from, double to);

}  // namespace lascaux
