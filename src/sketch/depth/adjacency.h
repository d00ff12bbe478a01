#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <vector>

#include "lascaux/sketch/parts.h"

/// @file
/// Which parts share lines with which, read from the planar map.

namespace lascaux {

/// For every half-edge the part on whose outline it lies (limbs before the face that they were cut
/// from), -1 for none.
struct Adjacency {
  std::vector<int> owner;
  /// Length of the lines shared by two parts; symmetric, no entry where there is none.
  std::vector<std::map<int, double>> shared;
};

Adjacency AdjacencyOf(const PlanarMap& map, const Parts& parts);

/// Middle, by length, of the lines that parts `a` and `b` share; none if they share none.
std::optional<Eigen::Vector2d> MiddleOfShared(const PlanarMap& map, const Parts& parts,
                                              const Adjacency& adjacency,
                                              const std::pair<int, int>& pair);

/// Parts met when walking along the outline of the limb's parent from its closed ends, both ways,
/// up to the next limb (§5.1: marching).
std::vector<int> March(const PlanarMap& map, const Parts& parts, const Adjacency& adjacency,
                       int limb);

/// Centroid of the area of a ring.
Eigen::Vector2d Centroid(const std::vector<Eigen::Vector2d>& ring);

}  // namespace lascaux
