#pragma once

#include <Eigen/Core>
#include <vector>

#include "lascaux/sketch/planar_map.h"
#include "sketch/map/polyline.h"

/// @file
/// The boundary of a cycle, and the paths that hang on it.

namespace lascaux {

/// A dangling path: both half-edges lie in one cycle. It hangs on the boundary by its closed end;
/// its other end is open (§4.2).
struct DanglingPath {
  Polyline points;   ///< from the closed end to the open end
  int position = 0;  ///< index in Boundary::half_edges of the half-edge that leaves the closed end
  std::vector<int> edges;  ///< of the map
};

/// The closed walk of half-edges around a face, without what hangs into it.
struct Boundary {
  std::vector<int> half_edges;
  std::vector<DanglingPath> paths;  ///< in the order of the walk
};

/// The boundary of a bounded cycle; of a tree that hangs on it, the longest path.
Boundary BoundaryOf(const PlanarMap& map, int cycle);

}  // namespace lascaux
