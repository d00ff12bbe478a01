#pragma once

#include <vector>

#include "lascaux/sketch/trace_picture.h"
#include "sketch/trace/ink_graph.h"

namespace lascaux::trace {

/// Where a line ends: freely (on_line < 0, meets nothing), or on another line.
struct LineEnd {
  int on_line = -1;  ///< index of the line that it ends on; its own index for a line on itself
};

/// A line as the pen drew it, through junctions.
struct Line {
  std::vector<Eigen::Vector2d> points;  ///< about a pixel apart; a closed one ends where it begins
  double width = 0;                     ///< of its ink, median
  bool closed = false;
  LineEnd ends[2];
};

/// Re-solves every junction and joins branches to lines.
///
/// Near a junction thinned ink is not the pen's path: there, up to the radius of the ink, branches
/// are cut and extended along their tangents. Two that agree to within `corner` degrees are one
/// line, the bar; others end on a bar where they hit it, or merge with it,, or all in one point
/// when there is none. Branches shorter than `junction` widths between two junctions belong to the
/// junction, unless they enclose a region. A short spur where two lines meet at a sharp angle is
/// the tip of their corner.
std::vector<Line> LinesOf(const InkGraph& graph, const Tone& coverage,
                          const TracePictureOptions& options);

}  // namespace lascaux::trace
