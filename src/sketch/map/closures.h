#pragma once

#include <Eigen/Core>
#include <vector>

#include "lascaux/sketch/planar_map.h"

/// @file
/// Lines that could close the gaps of a drawing, each with its price.

namespace lascaux {

/// A straight line across a gap, from a free end on the outside of the drawing.
struct Closure {
  Eigen::Vector2d from, to;
  Eigen::Vector2d from_direction, to_direction;  ///< unit, of the lines that it goes on from, away
                                                 ///< from them; zero where it meets a line's middle
  double price = 0;  ///< an area in sketch units: what has to be enclosed for it

  double Length() const { return (to - from).norm(); }
};

/// How far to look, and what is taken for the gap of one line.
struct ClosureSearch {
  double reach = 0;     ///< longest closure, in sketch units
  double max_turn = 0;  ///< radians; closures above a slip of the pen that turn more are left out
};

/// Closures from each free end on the outside: to other free ends, to the nearest place of each
/// line, and to the line that it points at; none of them crosses a line. A price is the length
/// squared, several times, more for turns and for meeting a line's middle. The few cheapest of each
/// end; n log n.
std::vector<Closure> FindClosures(const PlanarMap& map, const ClosureSearch& search);

}  // namespace lascaux
