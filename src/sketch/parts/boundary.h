#pragma once

#include <Eigen/Core>
#include <vector>

#include "lascaux/sketch/planar_map.h"
#include "sketch/map/polyline.h"

/// @file
/// The boundary of a cycle, and the suggestive curves that hang on it.

namespace lascaux {

/// A suggestive curve: a path whose both half-edges lie in one cycle, closed where it meets the boundary, open at its other end (§4.2).
struct SuggestiveCurve {
  Polyline points;            ///< from the closed end to the open end
  int position = 0;           ///< index in Boundary::half_edges of the half-edge that leaves the closed end
  double length = 0;
  std::vector<int> edges;     ///< of the map
  Eigen::Vector2d departure;  ///< direction at the closed end, into the face
  Eigen::Vector2d tip;        ///< direction at the open end, running on
  /// Turns at the closed end, 0 to pi: from the boundary before into the curve, from the boundary after (walked
  /// backwards) into the curve, and along the boundary past it.
  double turn_before = 0, turn_after = 0, turn_through = 0;
};

/// The closed walk of half-edges around a face, without what hangs into it.
struct Boundary {
  std::vector<int> half_edges;
  std::vector<SuggestiveCurve> curves;  ///< in the order of the walk

  int size() const { return static_cast<int>(half_edges.size()); }
};

/// The boundary of a bounded cycle with its suggestive curves; trees give their longest path.
Boundary BoundaryOf(const PlanarMap& map, int cycle);

/// Points of the walk from half-edge `from` up to, not including, half-edge `to` (cyclic; equal means once around).
Polyline WalkPoints(const PlanarMap& map, const Boundary& boundary, int from, int to);

}  // namespace lascaux
