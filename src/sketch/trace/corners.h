#pragma once

#include <cstddef>
#include <vector>

#include "sketch/trace/ink.h"
#include "sketch/trace/junctions.h"

namespace lascaux::trace {

/// What a corner is.
struct CornerOptions {
  double degrees = 50;  ///< that the direction turns within two widths
  double width = 1;     ///< of the ink, pixels
};

/// The points of a line between its corners, each piece with both of its ends. A corner is where
/// the extensions of the line's two sides meet, since thinned ink cuts corners short; only if there
/// is ink. One piece for a line without corners; a closed line with any begins at one.
std::vector<std::vector<Eigen::Vector2d>> PiecesBetweenCorners(const Line& line,
                                                               const Tone& coverage,
                                                               const CornerOptions& options);

}  // namespace lascaux::trace
