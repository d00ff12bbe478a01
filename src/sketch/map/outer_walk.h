#pragma once

#include <Eigen/Core>
#include <vector>

#include "lascaux/sketch/planar_map.h"

/// @file
/// The walk around the outside of the drawing, on which gaps are two places that are near in the
/// plane and far along.

namespace lascaux {

/// A point of the walk.
struct WalkPoint {
  Eigen::Vector2d position;
  int half_edge = 0;       ///< the one that it lies on
  bool is_tip = false;     ///< a free end: the walk turns back here
  double arc = 0;          ///< arc length from the walk's beginning
  double double_area = 0;  ///< twice the area swept so far, seen from the walk's first point
};

/// An outer cycle, sampled at most `spacing` apart; all its own points are kept.
struct OuterWalk {
  std::vector<WalkPoint> points;
  double length = 0;
  double double_area = 0;

  /// Area of the larger face that a bridge between points i and j would close; negative when it
  /// closes none.
  double FaceArea(std::size_t i, std::size_t j) const;
  /// Distance along the walk, the shorter way.
  double Along(std::size_t i, std::size_t j) const;
};

/// The outer walks of a map, in the order of its cycles.
std::vector<OuterWalk> OuterWalks(const PlanarMap& map, double spacing);

}  // namespace lascaux
