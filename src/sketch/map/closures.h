#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "lascaux/sketch/planar_map.h"

/// @file
/// Lines that could close the gaps of a drawing, each with its price.

namespace lascaux {

/// A straight line across a gap, from a free end.
struct Closure {
  Eigen::Vector2d from, to;
  int half_edge = 0;                             ///< the one that begins at `from`
  Eigen::Vector2d from_direction, to_direction;  ///< unit, of the lines that it goes on from, away
                                                 ///< from them; zero where it meets a line's middle
  double price = 0;  ///< an area in sketch units: what has to be enclosed for it

  double turn = 0;  ///< radians, the larger of those between it and the lines
  double Length() const { return (to - from).norm(); }
};

/// Which free ends are looked at, and which lines they may meet: those on the outside of the
/// drawing, or those inside of its faces.
enum class ClosureSide : std::uint8_t { kOutside, kInside };

/// How far to look, and what is taken for the gap of one line.
struct ClosureSearch {
  ClosureSide side = ClosureSide::kOutside;
  double reach = 0;     ///< longest closure, in sketch units
  double max_turn = 0;  ///< radians; closures above a slip of the pen that turn more are left out
};

/// Closures from each free end on one side of the outline: to other free ends, to the nearest place
/// of each line, and to the line that it points at; none of them crosses a line. A price is the
/// length squared, several times, more for turns and for meeting a line's middle. The few cheapest
/// of each end; n log n.
std::vector<Closure> FindClosures(const PlanarMap& map, const ClosureSearch& search);

}  // namespace lascaux
