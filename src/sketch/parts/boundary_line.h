#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "lascaux/sketch/planar_map.h"
#include "sketch/parts/boundary.h"

/// @file
/// The boundary as one closed polyline with arc length, so that a limb may be cut at any place of
/// it.

namespace lascaux {

/// Closed walk around a face; places on it are arc lengths, taken modulo `length`.
struct BoundaryLine {
  Polyline points;                ///< the last is joined to the first
  std::vector<int> half_edges;    ///< of the piece from points[i] to the next
  std::vector<double> arcs;       ///< of points[i]
  std::vector<double> node_arcs;  ///< of the beginning of each half-edge of the Boundary
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

/// A dangling path, rooted on the line and measured: perhaps one side of a limb.
struct SuggestiveCurve {
  Polyline points;  ///< from the closed end to the open end
  double arc = 0;   ///< place of the closed end
  double length = 0;
  std::vector<int> edges;     ///< of the map
  Eigen::Vector2d departure;  ///< direction at the closed end, into the face
  Eigen::Vector2d tip;        ///< direction at the open end, running on
  /// Turns at the closed end, 0 to pi: from the boundary before into the curve, from the boundary
  /// after (walked backwards) into the curve, and along the boundary past it.
  double turn_before = 0, turn_after = 0, turn_through = 0;
};

/// A stretch of the walk.
struct BoundaryStretch {
  Polyline points;              ///< both ends included
  std::vector<int> half_edges;  ///< one for each piece between two points
};

BoundaryLine LineOf(const PlanarMap& map, const Boundary& boundary);

/// The paths of a boundary as suggestive curves, in the order of the walk. Where a path runs along
/// the boundary first (a limb's edge drawn over the outline), it is rooted where it leaves it.
std::vector<SuggestiveCurve> SuggestiveCurvesOf(const PlanarMap& map, const Boundary& boundary,
                                                const BoundaryLine& line);

/// Tangents at closed and open ends are taken over this length: longer than a hook of the pen,
/// shorter than a bend.
double TangentReach(const PlanarMap& map);

/// The place on the line that is nearest to a point, and how near.
std::pair<double, double> NearestPlace(const BoundaryLine& line, const Eigen::Vector2d& point);

/// The walk from one place to another, going ahead.
BoundaryStretch Stretch(const BoundaryLine& line, double from, double to);

}  // namespace lascaux
